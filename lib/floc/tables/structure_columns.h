#pragma once

#include <vector>

#include "floc/io/state_file.h"
#include "floc/tables/column.h"
#include "floc/tables/structure_rows.h"

namespace floc {

/// The columns of the table of `floc structure`.
std::vector<Column<StructureRow>> structure_columns();

/// The row of `floc structure` of one state, in one call: see docs/columns.md for its columns.
/// @param file     name of the state in the table and in messages
/// @param further  takes the other tables that are asked for; null: none is kept
/// @throws InputError for options that are no options, or that the state cannot have
Table structure_table(const AnyState& state, const StructureTableOptions& options = {},
                      const std::string& file = "", Series* further = nullptr, const Remarks& remarks = {});

}  // namespace floc
