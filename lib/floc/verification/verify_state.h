#pragma once

#include <string>
#include <vector>

#include "floc/io/state_file.h"
#include "floc/verification/verification.h"

namespace floc {

/// Verifies a state completely, as `floc verify` does, by verify_equilibrium(), check_against_scene() and
/// verify_boundary_motion(), in this order. The state is an equilibrium if every criterion holds.
/// @param file  name of the state in messages; a state from which its scene starts is looked for beside this file
std::vector<Criterion> verify_state(const AnyState& state, const std::string& file = "");

}  // namespace floc
