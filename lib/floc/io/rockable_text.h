#pragma once

#include <string>

#include "floc/io/state_file.h"

namespace floc {

/// Writes a packing in 3D as a configuration of Rockable. The shapes are written to a second file in the same folder.
/// The name of the second file has the extension .shp instead of .conf. Walls become driven plates, which precede the
/// grains in the list of bodies, and contacts become interactions with forces. The files contain no contact law, no
/// stiffnesses and no rolling or twisting moments.
/// @throws InputError for packings that Rockable cannot represent: packings in 2D, packings that are periodic along
/// some axes only, bonds, and shapes without rounding; also for the path "-" (standard output), and for file names that
/// end in .shp or have blanks or #
void write_rockable(const std::string& path, const AnyState& state);

}  // namespace floc
