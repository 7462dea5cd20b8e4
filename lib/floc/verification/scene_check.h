#pragma once

#include <string>
#include <vector>

#include "floc/packing/state.h"
#include "floc/verification/verification.h"

namespace floc {

/// Compares a state with the text of the scene that it carries. The criteria are
///   mass        masses of the grains, against radii and density
///   tolerances  recorded tolerances, against those of the scene. Without a scene they must be at most 10, because
///               any packing satisfies larger ones.
///   scene       number of other differences: unit system, place on the load path, load on the boundary, contact law,
///               law and masses of walls. A scene that starts from a saved state is compared only if that state
///               is found.
/// @param file  name of the state in messages
template <int Dim>
std::vector<Criterion> check_against_scene(const std::string& file, const State<Dim>& state);

}  // namespace floc
