#pragma once

#include <string>
#include <vector>

#include "floc/packing/state.h"
#include "floc/verification/verification.h"

namespace floc {

/// Compares a state with the text of the scene that is stored in it. The criteria are
///   mass        largest relative difference of the masses of the grains from the masses that radii and density give
///   tolerances  number of recorded tolerances that differ from those of the scene. Without a scene they must be at
///               most 10, because any packing satisfies larger ones.
///   scene       number of other differences: unit system, place on the load path, load on the boundary, contact law,
///               contact law of the walls, masses of the walls. A scene that starts from a saved state is compared
///               only if that state is found.
/// @param file  name of the state file, for messages and to find the saved state from which the scene starts
template <int Dim>
std::vector<Criterion> check_against_scene(const std::string& file, const State<Dim>& state);

}  // namespace floc
