#pragma once

#include <optional>
#include <string>

namespace floc {

/// Returns the mass of a grain over the cube of its diameter (for disks, over the square). It follows from the density
/// of the grains that the scene gives; without a density, in reduced units, it is 1. Returns std::nullopt if the scene
/// takes its grains from a saved state.
/// @param scene  text of the scene (TOML)
/// @param dimension  2 for disks, 3 for spheres
/// @param place  name of the text, for messages
/// @throws InputError if the text is not TOML
std::optional<double> mass_per_cubed_diameter(const std::string& scene, int dimension,
                                              const std::string& place);

}  // namespace floc
