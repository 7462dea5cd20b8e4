#pragma once

#include <string>
#include <vector>

#include "floc/packing/state.h"
#include "floc/verification/verification.h"

namespace floc {

/// What a state has of its scene, held against the text of the scene that it carries:
///   mass        masses of the grains, against radii and density
///   tolerances  those recorded, against those of the scene; without a scene they are to be at most 10, since
///               any packing is within larger ones
///   scene       number of other things that are not those of the scene: unit system, place on the load path, what the
///               boundary is loaded with, contact law, law and masses of walls. A scene that starts from a saved state
///               is compared where that state is found.
/// @param file  what messages call the state
template <int Dim>
std::vector<Criterion> check_against_scene(const std::string& file, const State<Dim>& state);

}  // namespace floc
