#pragma once

#include <string>
#include <vector>

#include "floc/io/table.h"
#include "floc/verification/verification.h"

namespace floc {

/// Adds the row of `floc verify` of a state, and the columns to a table without any: whether every criterion holds,
/// those that do not, and the value that each found.
/// @param criteria  as verify_state() returns them
void add_verification_row(const std::string& file, const std::vector<Criterion>& criteria, Table& table);

}  // namespace floc
