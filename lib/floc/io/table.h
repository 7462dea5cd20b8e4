#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace floc {

enum class TableFormat { table, csv, json };

/// One value of a table. monostate is an undefined value (empty in csv, null in json, "-" in a table).
using TableValue = std::variant<std::monostate, bool, std::int64_t, double, std::string>;

/// Returns a value of a table; it is undefined for a missing number or an empty text.
TableValue or_undefined(const std::optional<double>& number);
TableValue or_undefined(const std::string& text);

/// Rows of named values, as commands print them.
struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<TableValue>> rows;  ///< each as long as `columns`
};

/// Prints a table. csv: the first line holds only the column names, and numbers round-trip. json: an array of
/// objects. table: aligned columns with 6 significant digits. A number that is not finite is undefined.
void write_table(std::ostream& out, const Table& table, TableFormat format);

}  // namespace floc
