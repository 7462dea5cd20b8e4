#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "floc/base/double_double.h"
#include "floc/base/packed_strings.h"

namespace floc {

/// A table of text cells with named columns, as read from a csv file. The first line names the columns; they are
/// separated by commas, tabs or semicolons (the first of these that the line contains). Empty lines and lines that
/// begin with # are skipped. A cell that contains separators is in double quotes. Readers of other text formats fill
/// such a table row by row with add_row().
class CsvTable {
 public:
  CsvTable() = default;

  /// Makes a table without rows. @param place  name of the table in messages
  CsvTable(std::string place, std::vector<std::string> columns);

  /// Adds a row. @param line  number of the line in the file that holds the row, from 1
  /// @throws InputError if the number of cells is not the number of columns
  void add_row(int line, const std::vector<std::string>& cells);

  /// Reads a file. @param path  the file; "-" reads stdin
  /// @throws InputError naming file and line if the file cannot be read or has no header, or if a line has too many or
  /// too few cells
  static CsvTable read(const std::string& path);

  /// Reads a table from a stream. @param place  name of the table in messages
  static CsvTable parse(const std::string& place, std::istream& in);

  const std::vector<std::string>& columns() const { return columns_; }
  int n_rows() const { return static_cast<int>(lines_.size()); }
  bool has(const std::string& name) const;

  /// Returns the index of a column.
  /// @throws InputError listing the columns of the table if no column, or more than one, has this name
  int column(const std::string& name) const;

  std::string text(int row, int column) const { return std::string(cell(row, column)); }
  bool is_empty(int row, int column) const { return cell(row, column).empty(); }

  /// Returns a cell as a finite number. integer() accepts "3.0" and "3.000e+00", because programs write whole tables
  /// as real numbers.
  /// @throws InputError naming file, line, column and value if the cell is not a finite number, or not an integer
  double number(int row, int column) const;
  /// Returns a cell as a sum of two doubles, which keeps more digits than one double: see decimal().
  /// @throws InputError under the conditions of number()
  DoubleDouble double_double_number(int row, int column) const;
  std::int64_t integer(int row, int column) const;

  /// "file:line" of a row, for messages.
  std::string place(int row) const;
  /// Line of a row in the file, from 1.
  int line(int row) const { return lines_[row]; }
  /// Name of the table, for messages.
  const std::string& place() const { return place_; }

 private:
  /// Reports a line with the wrong number of cells. @param hint  end of the message
  /// @throws InputError always
  [[noreturn]] void refuse_count(int line, std::size_t n_cells, const char* hint) const;
  std::string_view cell(int row, int column) const { return cells_[row * columns_.size() + column]; }

  std::string place_;
  std::vector<std::string> columns_;
  std::vector<int> lines_;  ///< for each row, number of its line in the file
  PackedStrings cells_;     ///< texts of all cells, row after row
};

}  // namespace floc
