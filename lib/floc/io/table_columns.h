#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "floc/io/csv.h"

namespace floc {

/// Headers of columns in an input table, as the user gives them by `--columns NAME=COLUMN,...`. The key is NAME, the
/// name that floc uses for a quantity; the value is the header. The header may be followed by the unit of the column in
/// brackets, as in "e [%]". If a quantity has one value for the whole table, the user may give a number, with or
/// without unit, instead of a header.
using ColumnNames = std::map<std::string, std::string>;

/// A column of a table: its index and its unit.
struct UnitColumn {
  int index;
  std::string unit;  ///< unit of the column, such as kPa; empty if none is given
  /// Whether the user gave the unit or, for numbers without unit, "[1]". If true, it is known whether the numbers are
  /// in percent.
  bool unit_is_given = false;
};

/// A number that the user gave instead of a column, and its unit, which may be empty.
struct GivenNumber {
  double value;
  std::string unit;
};

/// Finds the columns of a table by the names that floc uses for quantities. The headers of the table may differ from
/// these names.
class NamedColumns {
 public:
  NamedColumns(const CsvTable& table, ColumnNames names) : table_(table), names_(std::move(names)) {}

  const CsvTable& table() const { return table_; }
  const ColumnNames& names() const { return names_; }
  bool is_named(const std::string& name) const { return names_.contains(name); }

  /// Finds the column of the quantity `name`. If the user named a column, returns that column. If not, returns the
  /// column whose header is `name`, with or without a unit; if there is none, the column whose header is a usual name
  /// of the quantity (is_usual_name()). If the line of headers has no such column, the lines above it are searched. The
  /// unit is taken from the user, the row of units or the header.
  /// @return the column; nothing if no column is found
  /// @throws InputError if two columns match, or if the table has no column with the name that the user gave
  std::optional<UnitColumn> find(const std::string& name) const;

  /// Finds the column as find() does, but ignores usual names.
  std::optional<UnitColumn> find_exactly(const std::string& name) const;

  /// Whether the user named a column for the quantity `name`, or find() finds a column.
  bool has(const std::string& name) const { return is_named(name) || find(name).has_value(); }

  /// Returns the column that find() returns.
  /// @throws InputError listing the columns of the table if there is no such column
  UnitColumn unit_column(const std::string& name) const;
  int column(const std::string& name) const { return unit_column(name).index; }

  /// Returns the unit of the column with a given index, from the row of units or from the header; empty if neither
  /// gives a unit.
  std::string unit_of(int index) const;

  /// Returns the number that the user gave for the quantity `name` instead of a column; nothing if the user gave no
  /// number.
  std::optional<GivenNumber> given_number(const std::string& name) const;

 private:
  /// Returns a header without its unit. The number in the header "force[1]" is no unit if the table also has the column
  /// "force[2]": the two are components of a vector. Such a header is returned unchanged.
  std::string without_unit(const std::string& header) const;
  std::optional<UnitColumn> with_header(const std::string& name, const std::string& header) const;

  const CsvTable& table_;
  ColumnNames names_;
};

/// Returns the names of columns that help to find the header of a table: `names` and, in addition, the headers that the
/// user gave.
std::vector<std::string> wanted_names(std::vector<std::string> names, const ColumnNames& given);

}  // namespace floc
