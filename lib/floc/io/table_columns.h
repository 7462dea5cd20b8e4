#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "floc/io/csv.h"

namespace floc {

/// Headers of columns in an input table, given by `--columns NAME=COLUMN,...`. The key is the name that floc uses for a
/// quantity. A unit in brackets after the header, as in "e [%]", is the unit of the column. For a quantity that has one
/// value for the whole table, a number, with or without unit, may be given instead of a header.
using ColumnNames = std::map<std::string, std::string>;

/// A column of a table: its index and its unit.
struct UnitColumn {
  int index;
  std::string unit;  ///< unit of the column, such as kPa; empty if none is given
  /// Whether the user gave the unit, or gave "[1]" for numbers without unit. In both cases it is known whether the
  /// numbers are in percent.
  bool unit_is_given = false;
};

/// A number that the user gave instead of a column, with its unit, which is empty if there is none.
struct GivenNumber {
  double value;
  std::string unit;
};

/// Finds the columns of a table by the names that floc uses, even if the headers of the table differ from these names.
class NamedColumns {
 public:
  NamedColumns(const CsvTable& table, ColumnNames names) : table_(table), names_(std::move(names)) {}

  const CsvTable& table() const { return table_; }
  const ColumnNames& names() const { return names_; }
  bool is_named(const std::string& name) const { return names_.contains(name); }

  /// Finds the column of the quantity `name`. The first of these columns that exists is returned: the column that the
  /// user named; the column whose header is `name`, with or without a unit; the column whose header is a usual name of
  /// the quantity (is_usual_name()). If the header does not contain the name, lines above the header are searched. The
  /// unit is given by the user, by the header or by the row of units.
  /// @return the column; nothing if there is none
  /// @throws InputError if two columns match, or if the table has no column with the name that the user gave
  std::optional<UnitColumn> find(const std::string& name) const;

  /// Finds the column as find() does, but ignores usual names.
  std::optional<UnitColumn> find_exactly(const std::string& name) const;

  /// Whether the user named a column for `name`, or find() finds one.
  bool has(const std::string& name) const { return is_named(name) || find(name).has_value(); }

  /// Returns the result of find().
  /// @throws InputError listing the columns of the table if there is no such column
  UnitColumn unit_column(const std::string& name) const;
  int column(const std::string& name) const { return unit_column(name).index; }

  /// Returns the unit of the column with a given index, from the row of units or from the header; empty if there is
  /// none.
  std::string unit_of(int index) const;

  /// Returns the number that the user gave instead of a column for `name`; nothing if the user gave none.
  std::optional<GivenNumber> given_number(const std::string& name) const;

 private:
  std::optional<UnitColumn> with_header(const std::string& name, const std::string& header) const;

  const CsvTable& table_;
  ColumnNames names_;
};

/// Returns the names of columns that help to find the header of a table: `names`, and the headers that the user gave.
std::vector<std::string> wanted_names(std::vector<std::string> names, const ColumnNames& given);

}  // namespace floc
