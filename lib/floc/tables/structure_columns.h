#pragma once

#include <vector>

#include "floc/io/state_file.h"
#include "floc/tables/column.h"
#include "floc/tables/structure_rows.h"

namespace floc {

/// Returns the columns of the table of `floc structure`.
std::vector<Column<StructureRow>> structure_columns();

/// Computes the table of `floc structure` for one state in a single call; docs/columns.md describes its columns.
/// @param file     name of the state in the table and in messages
/// @param further  receives the tables that the options select in addition to the returned table; null if they are not
/// needed
/// @throws InputError if an option is not valid or cannot be applied to the state
Table structure_table(const AnyState& state, const StructureTableOptions& options = {},
                      const std::string& file = "", Series* further = nullptr, const Remarks& remarks = {});

}  // namespace floc
