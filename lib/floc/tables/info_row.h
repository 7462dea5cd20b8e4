#pragma once

#include <string>

#include "floc/io/state_file.h"
#include "floc/io/table.h"

namespace floc {

/// Adds the row of a state to the table of `floc info`: contents of the state, residuals of equilibrium, step of the
/// load path, and provenance. If the table has no columns yet, the columns are added.
/// @param file  name of the state file, whose SHA-256 is one of the columns
/// @throws IoError if the file cannot be read
void add_info_row(const std::string& file, const AnyState& state, Table& table);

}  // namespace floc
