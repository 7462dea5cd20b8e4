#pragma once

#include <string>

#include "floc/io/state_file.h"

namespace floc {

/// Writes a packing in 3D as a configuration of Rockable (its file conf), and its shapes to a file beside it, whose name is
/// that of the configuration with the ending .shp. Walls become driven plates in front of the grains, and contacts become
/// interactions with forces. The files hold no contact law, no stiffnesses and no rolling or twisting moments.
/// @throws InputError for a packing in 2D, a packing that is periodic along some axes only, bonds, or shapes without rounding,
/// which Rockable does not have
void write_rockable(const std::string& path, const AnyState& state);

}  // namespace floc
