#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "floc/base/error.h"
#include "floc/io/table.h"

namespace floc {

/// A column of a table: its name, and a function that computes the cell of the column from a Row. A Row contains all
/// values of one row of the table.
template <class Row>
using Column = std::pair<std::string, std::function<TableValue(const Row&)>>;

/// Returns a table with the columns `columns` and one table row for each element of `rows`.
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

/// If a table has no columns yet, sets its columns to `names`. Otherwise an earlier state has set the columns, and the
/// function checks that they equal `names`.
/// @param file  file of the state that is about to add rows, for messages
/// @throws InputError if the table has other columns, because the earlier state has another dimension
inline void expect_columns(const std::string& file, const std::vector<std::string>& names, Table& table) {
  if (table.columns.empty()) table.columns = names;
  if (table.columns != names)
    throw InputError(file,
                     "this state differs in dimension from the states before it, but one table can only "
                     "contain states of one dimension");
}

/// Returns an integer as a cell of a table.
inline TableValue count(std::int64_t n) {
  return n;
}

}  // namespace floc
