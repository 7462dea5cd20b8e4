#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "floc/io/csv.h"

namespace floc {

/// Map from the name that floc uses for a quantity to the header of its column in an input table, as given by
/// `--columns NAME=COLUMN,...`. A unit in brackets behind the header, as in "e [%]", is that of the column. For a quantity
/// that has one value for the whole table, a number with or without unit may take the place of the header.
using ColumnNames = std::map<std::string, std::string>;

/// A column of a table: its index and its unit.
struct UnitColumn {
  int index;
  std::string unit;  ///< unit such as kPa; empty if none is given
  /// Whether the user gave the unit, or said with "[1]" that there is none. This answers the question whether numbers
  /// are in percent.
  bool unit_is_given = false;
};

/// A number that the user gave in place of a column, with its unit; the unit is empty if there is none.
struct GivenNumber {
  double value;
  std::string unit;
};

/// Finds the columns of a table by the names that floc uses for them, although they may have other names in the table.
class NamedColumns {
 public:
  NamedColumns(const CsvTable& table, ColumnNames names) : table_(table), names_(std::move(names)) {}

  const CsvTable& table() const { return table_; }
  const ColumnNames& names() const { return names_; }
  bool is_named(const std::string& name) const { return names_.contains(name); }

  /// Finds the column that floc calls `name`, in this order: the column that the user named; the column whose header is
  /// `name`, with or without a unit; the column whose header is a usual name of the quantity (is_usual_name()). Names in
  /// lines above the header count where the header does not have the name. The unit is that of the user, of the header
  /// or of the row of units.
  /// @return the column; nothing if there is none
  /// @throws InputError if two columns have the name, or if there is no column with the name that the user gave
  std::optional<UnitColumn> find(const std::string& name) const;

  /// Finds the column as find() does, but not by usual names.
  std::optional<UnitColumn> find_exactly(const std::string& name) const;

  /// Whether the user named a column for `name`, or find() finds one.
  bool has(const std::string& name) const { return is_named(name) || find(name).has_value(); }

  /// Returns what find() returns. @throws InputError listing the columns of the table if there is no such column
  UnitColumn unit_column(const std::string& name) const;
  int column(const std::string& name) const { return unit_column(name).index; }

  /// Returns the unit of a column by its index: that of the row of units or of the header; empty if there is none.
  std::string unit_of(int index) const;

  /// Returns the number that the user gave in place of a column for `name`; nothing if the user gave none.
  std::optional<GivenNumber> given_number(const std::string& name) const;

 private:
  std::optional<UnitColumn> with_header(const std::string& name, const std::string& header) const;

  const CsvTable& table_;
  ColumnNames names_;
};

/// Returns the names of columns that help to find the header of a table: `names` and the headers that the user gave.
std::vector<std::string> wanted_names(std::vector<std::string> names, const ColumnNames& given);

}  // namespace floc
