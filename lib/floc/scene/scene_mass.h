#pragma once

#include <optional>
#include <string>

namespace floc {

/// Returns the mass of a grain over the cube of its diameter (for disks, its square), as the text of a scene gives
/// it: from the density, or 1 in reduced units without a density. None if the grains are those of a saved state.
/// @param place  name of the text in messages
/// @throws InputError if the text is not TOML
std::optional<double> mass_per_cubed_diameter(const std::string& scene, int dimension,
                                              const std::string& place);

}  // namespace floc
