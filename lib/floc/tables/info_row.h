#pragma once

#include <string>

#include "floc/io/state_file.h"
#include "floc/io/table.h"

namespace floc {

/// Adds the row of `floc info` of a state, and the columns to a table without any: contents, residuals, place on the
/// load path, and provenance.
/// @param file  of the state, whose SHA-256 is a column
/// @throws IoError if the file cannot be read
void add_info_row(const std::string& file, const AnyState& state, Table& table);

}  // namespace floc
