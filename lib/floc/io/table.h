#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace floc {

enum class TableFormat { table, csv, json };

/// One value of a table. monostate is an undefined value, printed as an empty cell in csv, null in json and "-" in a
/// table.
using TableValue = std::variant<std::monostate, bool, std::int64_t, double, std::string>;

/// Converts an optional number or a text to a value of a table. A missing number or an empty text becomes an undefined
/// value.
TableValue or_undefined(const std::optional<double>& number);
TableValue or_undefined(const std::string& text);

/// Table with named columns, which the commands of floc print.
struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<TableValue>> rows;  ///< each row has one value per column
};

/// Prints a table in one of these formats:
///   csv    the first line contains the names of the columns; numbers have all digits needed to read them back exactly
///   json   an array with one object per row
///   table  aligned columns; numbers have 6 significant digits
/// A number that is not finite is printed as an undefined value.
void write_table(std::ostream& out, const Table& table, TableFormat format);

}  // namespace floc
