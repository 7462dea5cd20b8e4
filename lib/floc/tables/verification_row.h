#pragma once

#include <string>
#include <vector>

#include "floc/io/table.h"
#include "floc/verification/verification.h"

namespace floc {

/// Adds the row of a state to the table of `floc verify`: whether all criteria of equilibrium hold, the names of the
/// criteria that do not hold, and the value for each criterion. If the table has no columns yet, the columns are added.
/// @param criteria  result of verify_state() for the state
void add_verification_row(const std::string& file, const std::vector<Criterion>& criteria, Table& table);

}  // namespace floc
