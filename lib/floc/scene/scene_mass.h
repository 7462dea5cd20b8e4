#pragma once

#include <optional>
#include <string>

namespace floc {

/// Mass over the cube of the diameter (for disks, its square) that the text of a scene gives its grains: from
/// their density, or 1 in reduced units without a density. None where the grains are those of a saved state.
/// @param place  what messages call the text
/// @throws InputError if the text is not TOML
std::optional<double> mass_per_cubed_diameter(const std::string& scene, int dimension,
                                              const std::string& place);

}  // namespace floc
