#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "floc/base/double_double.h"
#include "floc/base/packed_strings.h"
#include "floc/io/table_layout.h"
#include "floc/io/table_text.h"

namespace floc {

/// A table of text cells with named columns, read from a text file. Blank lines, lines that begin with #, and titles
/// above the names of the columns are skipped. find_table_layout() documents how the names, the units and the separator
/// of the cells are found; decoded_table() documents the accepted encodings. A cell that contains separators must be
/// enclosed in double quotes. Numbers may have decimal commas if the cells are not separated by commas. Readers of
/// other text formats fill a table row by row with add_row().
class CsvTable {
 public:
  CsvTable() = default;

  /// Makes a table without rows. @param place  name of the table in messages, such as the path of its file
  CsvTable(std::string place, std::vector<std::string> columns);

  /// Adds a row. @param line  number (from 1) of the line of the file that contains the row
  /// @throws InputError if the number of cells is not the number of columns
  void add_row(int line, const std::vector<std::string>& cells);

  /// Reads a table from a file. @param path  path of the file; "-" reads standard input
  /// @param wanted  names of columns that the caller needs; they help to distinguish the line of names from titles
  /// @throws InputError naming file and line if the file cannot be read, has no line of column names, or has a line
  /// with too many or too few cells
  static CsvTable read(const std::string& path, const std::vector<std::string>& wanted = {});

  /// Reads a table from the stream `in`, and throws like read(). @param place  name of the table in messages
  static CsvTable parse(const std::string& place, std::istream& in,
                        const std::vector<std::string>& wanted = {});

  const std::vector<std::string>& columns() const { return columns_; }
  /// Other names of the columns, from the lines above the line of names that columns() returns. There is one list per
  /// line, that of the nearest line first. A list has one name per column; a name may be empty.
  const std::vector<std::vector<std::string>>& other_names() const { return layout_.other_names; }
  /// Returns the cell of a column in the row of units below the names; empty if the table has no row of units.
  std::string unit_cell(int column) const;
  /// Returns a text that lists the differences between the layout of the table and that of a plain csv table:
  /// separator, decimal commas, encoding, lines above the names, row of units. The text is empty for a plain csv table.
  std::string description() const;
  /// Returns the number of rows as text: "27 rows".
  std::string rows_in_words() const;
  int n_rows() const { return static_cast<int>(lines_.size()); }
  bool has(const std::string& name) const;

  /// Returns the index of the column with the name `name`.
  /// @throws InputError listing the columns of the table if no column, or more than one, has this name
  int column(const std::string& name) const;

  std::string text(int row, int column) const { return std::string(cell(row, column)); }
  bool is_empty(int row, int column) const { return cell(row, column).empty(); }

  /// Returns the text of a cell. If the table has decimal commas and the text is a number, the comma becomes a point.
  std::string number_text(int row, int column) const;
  /// number() returns the finite number in a cell, and integer() returns the integer in a cell. integer() also accepts
  /// "3.0" and "3.000e+00", because many programs write integers like real numbers.
  /// @throws InputError naming file, line, column and value if the cell is not a finite number, or not an integer, or
  /// if it has a decimal point although other cells of the table have decimal commas
  double number(int row, int column) const;
  /// Converts the text of a cell to the sum of two doubles, which keeps more digits than one double: see decimal().
  /// @throws InputError under the conditions of number()
  DoubleDouble double_double_number(int row, int column) const;
  std::int64_t integer(int row, int column) const;

  /// Place of a row in messages: "file:line".
  std::string place(int row) const;
  /// Number (from 1) of the line of the file that contains a row.
  int line(int row) const { return lines_[row]; }
  /// Name of the table in messages.
  const std::string& place() const { return place_; }

 private:
  static CsvTable of_text(const std::string& place, const TableText& decoded,
                          const std::vector<std::string>& wanted);
  /// Reports a line with a wrong number of cells.
  /// @param hint  end of the message, which gives a likely reason; may be empty
  /// @throws InputError always
  [[noreturn]] void refuse_count(int line, std::size_t n_cells, const char* hint) const;
  std::string_view cell(int row, int column) const { return cells_[row * columns_.size() + column]; }
  [[noreturn]] void refuse_cell(int row, int column, const char* expected) const;
  void require_no_point(int row, int column) const;
  void add_line(const TableLine& line);

  std::string place_;
  TableLayout layout_;
  std::string encoding_;  ///< encoding of the file; empty for UTF-8
  /// First number with a decimal comma, and the line of the file that contains it. The line is 0 if the table has no
  /// decimal commas.
  std::string decimal_comma_;
  int decimal_comma_line_ = 0;
  std::vector<std::string> columns_;
  /// For each row of the table, number of the line of the file that contains the row.
  std::vector<int> lines_;
  PackedStrings cells_;  ///< texts of all cells, row after row
};

}  // namespace floc
