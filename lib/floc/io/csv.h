#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "floc/base/double_double.h"
#include "floc/base/packed_strings.h"

namespace floc {

/// A table of text cells with named columns, as read from a csv file. Empty lines and lines that begin with # are
/// skipped. The first line that is not skipped names the columns. Cells are separated by commas, tabs or semicolons: by
/// the first of these three characters, in this order, that the line of the names contains. A cell that contains
/// separators has to be enclosed in double quotes. Readers of other text formats fill such a table row by row with
/// add_row().
class CsvTable {
 public:
  CsvTable() = default;

  /// Makes a table without rows. @param place  name of the table in messages, such as the path of its file
  CsvTable(std::string place, std::vector<std::string> columns);

  /// Adds a row. @param line  number of the line of the file that contains the row, from 1
  /// @throws InputError if the number of cells is not the number of columns
  void add_row(int line, const std::vector<std::string>& cells);

  /// Reads a csv file. @param path  path of the file; "-" reads standard input
  /// @throws InputError naming file and line if the file cannot be read or has no header, or if a line has too many or
  /// too few cells
  static CsvTable read(const std::string& path);

  /// Reads a csv table from the stream `in`, and throws like read(). @param place  name of the table in messages
  static CsvTable parse(const std::string& place, std::istream& in);

  const std::vector<std::string>& columns() const { return columns_; }
  int n_rows() const { return static_cast<int>(lines_.size()); }
  bool has(const std::string& name) const;

  /// Returns the index of the column `name`.
  /// @throws InputError listing the columns of the table if no column, or more than one, has this name
  int column(const std::string& name) const;

  std::string text(int row, int column) const { return std::string(cell(row, column)); }
  bool is_empty(int row, int column) const { return cell(row, column).empty(); }

  /// Converts the text of a cell: number() to a finite number, integer() to an integer. integer() also accepts "3.0"
  /// and "3.000e+00", because many programs write integers like real numbers.
  /// @throws InputError naming file, line, column and value if the cell is not a finite number, or not an integer
  double number(int row, int column) const;
  /// Converts the text of a cell to the sum of two doubles, which keeps more digits than one double: see decimal().
  /// @throws InputError under the conditions of number()
  DoubleDouble double_double_number(int row, int column) const;
  std::int64_t integer(int row, int column) const;

  /// Place of a row in messages: "file:line".
  std::string place(int row) const;
  /// Number of the line of the file that contains a row, from 1.
  int line(int row) const { return lines_[row]; }
  /// Name of the table in messages.
  const std::string& place() const { return place_; }

 private:
  /// Reports a line with a wrong number of cells. @param hint  end of the message, which names a likely reason; may be
  /// empty
  /// @throws InputError always
  [[noreturn]] void refuse_count(int line, std::size_t n_cells, const char* hint) const;
  std::string_view cell(int row, int column) const { return cells_[row * columns_.size() + column]; }

  std::string place_;
  std::vector<std::string> columns_;
  /// For each row of the table, number of the line of the file that contains the row.
  std::vector<int> lines_;
  PackedStrings cells_;  ///< texts of all cells, row after row
};

}  // namespace floc
