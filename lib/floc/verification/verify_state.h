#pragma once

#include <string>
#include <vector>

#include "floc/io/state_file.h"
#include "floc/verification/verification.h"

namespace floc {

/// Verifies a state completely, like the command `floc verify`. Returns the criteria of verify_equilibrium() (for rigid
/// contacts, of verify_rigid()), check_against_scene() and verify_boundary_motion(), in this order. If every criterion
/// is met, the state is an equilibrium.
/// @param file  name of the state file, for messages; if the scene of the state starts from a saved state, floc looks
/// for this saved state in the directory of the file
/// @throws InputError if the contacts of grains with corners are elastic
std::vector<Criterion> verify_state(const AnyState& state, const std::string& file = "");

}  // namespace floc
