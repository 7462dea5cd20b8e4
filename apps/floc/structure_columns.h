#pragma once

#include <vector>

#include "columns.h"
#include "structure_rows.h"

namespace floc {

/// The columns of the table of `floc structure`.
std::vector<Column<StructureRow>> structure_columns();

}  // namespace floc
