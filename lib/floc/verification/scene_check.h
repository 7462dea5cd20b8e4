#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/packing/state.h"
#include "floc/verification/verification.h"

namespace floc {

/// Compares a state with its scene: the text of the file that describes the simulation, which is stored in the state.
/// The criteria are
///   mass        largest relative difference between the masses of the grains and the masses that follow from their
///               radii and the density of the scene
///   tolerances  number of recorded tolerances that differ from the tolerances of the scene. Without a scene, all
///               tolerances must be at most 10, because any packing satisfies larger tolerances.
///   scene       number of other differences: unit system, place on the load path, load on the boundary, contact law,
///               contact law of the walls, masses of the walls. A scene that starts from a saved state is compared
///               only if that state is found.
/// @param file  name of the state file, for messages; if the scene starts from a saved state, floc looks for this state
/// in the directory of the file
template <int Dim>
std::vector<Criterion> check_against_scene(const std::string& file, const State<Dim>& state);

/// Reads the scene of a state of rigid grains. Returns the largest gap at which a contact may have a force, divided by
/// the diameter of the smaller grain. The result is absent if the state has no scene, if the scene cannot be read, or
/// if the scene does not set this gap.
/// @param file  name of the state file, see check_against_scene()
template <int Dim>
std::optional<double> scene_gap_tolerance(const std::string& file, const State<Dim>& state);

}  // namespace floc
