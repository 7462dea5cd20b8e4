#pragma once

#include <string>
#include <vector>

#include "floc/io/state_file.h"
#include "floc/verification/verification.h"

namespace floc {

/// Verifies everything that a state says of itself, as `floc verify` does: verify_equilibrium(), check_against_scene()
/// and verify_boundary_motion(), in this order. A state is an equilibrium where every criterion holds.
/// @param file  name of the state in messages; a scene that starts from another state looks for it beside this file
std::vector<Criterion> verify_state(const AnyState& state, const std::string& file = "");

}  // namespace floc
