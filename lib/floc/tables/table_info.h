#pragma once

#include <string>
#include <vector>

#include "floc/io/table.h"
#include "floc/io/table_columns.h"

namespace floc {

/// Contents of a table file as floc reads them, without a fit.
struct TableInfo {
  std::string reading;             ///< summary in one line
  std::vector<std::string> notes;  ///< messages about rows that are left out and pressures that were converted
};

/// Names of all quantities that floc reads from tables of load paths, grains, contacts, forces and compacted samples.
std::vector<std::string> names_of_quantities();

/// Reads a table file as a load path, as grains or as contacts, depending on its columns. For each of its columns, adds
/// a row to the table of `floc info`: header, quantity, unit and range of the numbers.
/// @param names  headers of columns, given by `--columns NAME=COLUMN,...`
/// @throws InputError if the table cannot be read. If it is a load path with invalid values, the error is thrown after
/// its rows were added
TableInfo add_table_info(const std::string& file, const ColumnNames& names, Table& table);

}  // namespace floc
