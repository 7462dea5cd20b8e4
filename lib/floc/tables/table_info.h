#pragma once

#include <string>
#include <vector>

#include "floc/io/table.h"
#include "floc/io/table_columns.h"

namespace floc {

/// Summary of a table file, as floc reads it, without a fit.
struct TableInfo {
  std::string reading;             ///< summary in one line
  std::vector<std::string> notes;  ///< messages about rows that are left out and pressures that were converted
};

/// Names of all quantities that floc reads from tables of load paths, grains, contacts, forces and compacted samples.
std::vector<std::string> names_of_quantities();

/// Reads a table as a load path, as grains or as contacts, depending on its columns. Adds a row for each of its columns
/// to `table`, the table of `floc info`: header, quantity, unit and range of the numbers.
/// @param names      headers of columns, as `--columns NAME=COLUMN,...` gives them
/// @param phi_limit  see largest_solid_fraction()
/// @throws InputError if the table cannot be read. If a load path contains values that are not possible, the error is
/// thrown after the rows were added
TableInfo add_table_info(const std::string& file, const ColumnNames& names, double phi_limit, Table& table);

}  // namespace floc
