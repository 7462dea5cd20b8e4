#pragma once

#include <optional>
#include <string>

namespace floc {

/// Returns the mass of a grain divided by the cube of its diameter (for disks, by the square of the diameter). This
/// ratio is computed from the density in the scene. If the scene gives no density, the result is 1. Returns
/// std::nullopt if the scene takes its grains from a saved state.
/// @param scene  text of the scene (TOML)
/// @param dimension  2 for disks, 3 for spheres
/// @param place  name of the text, for messages
/// @throws InputError if the text is not TOML
std::optional<double> mass_per_cubed_diameter(const std::string& scene, int dimension,
                                              const std::string& place);

}  // namespace floc
