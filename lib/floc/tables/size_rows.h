#pragma once

#include <string>
#include <vector>

#include "floc/assembly/size_classes.h"
#include "floc/io/checked_state.h"
#include "floc/io/table.h"

namespace floc {

/// Returns the table of `floc scene check --sizes`, with a row for each interval of diameters.
Table size_table(const std::vector<SizeClass>& classes);

/// Adds to the table of `floc info --sizes` a row for each interval of the grain diameters of a state. The intervals
/// and the expected volume fractions come from the size distribution in the scene of the state. Without a scene that
/// can be read, the range of diameters is divided into four equal intervals.
/// @param file  name of the state file
void add_size_rows(const std::string& file, const AnyState& state, Table& table);

}  // namespace floc
