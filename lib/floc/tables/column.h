#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "floc/base/error.h"
#include "floc/io/table.h"

namespace floc {

/// A column of a table: its name and how a row fills it.
template <class Row>
using Column = std::pair<std::string, std::function<TableValue(const Row&)>>;

/// Returns a table with one row for each of `rows`.
template <class Row>
Table to_table(const std::vector<Column<Row>>& columns, const std::vector<Row>& rows) {
  Table table;
  for (const auto& [name, value] : columns) table.columns.push_back(name);
  for (const Row& row : rows) {
    std::vector<TableValue> values;
    for (const auto& [name, value] : columns) values.push_back(value(row));
    table.rows.push_back(std::move(values));
  }
  return table;
}

/// Sets the columns of an empty table that is filled from several states.
/// @throws InputError if the table already has other columns, as for a state of another dimension
inline void expect_columns(const std::string& file, const std::vector<std::string>& names, Table& table) {
  if (table.columns.empty()) table.columns = names;
  if (table.columns != names)
    throw InputError(file,
                     "differs in dimension from the states before it: one file holds states of one dimension");
}

/// Returns a count as a value of a table.
inline TableValue count(std::int64_t n) {
  return n;
}

}  // namespace floc
