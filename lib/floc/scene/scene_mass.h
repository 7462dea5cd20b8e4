#pragma once

#include <optional>
#include <string>

namespace floc {

/// Returns the mass of a grain over the cube of its diameter (over the square for disks). It follows from the density
/// given in the text of the scene, and is 1 in reduced units without a density. Returns std::nullopt if the scene takes
/// its grains from a saved state.
/// @param scene  text of the scene (TOML)
/// @param place  name of this text, for messages
/// @throws InputError if the text is not TOML
std::optional<double> mass_per_cubed_diameter(const std::string& scene, int dimension,
                                              const std::string& place);

}  // namespace floc
