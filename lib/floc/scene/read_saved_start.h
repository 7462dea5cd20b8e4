#pragma once

#include <string>

#include "floc/scene/scene.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Reads the keys of the table [assembly] that describe the saved state from which a run starts:
/// - `state`: the name of the state file;
/// - `copies`: the number of copies of the packing along each axis;
/// - `state_sha256`: the SHA-256 checksum of the file, which floc writes into the text of a scene.
///
/// Writes the number, sizes and density of the grains, the solid fraction, and a description of the start into the
/// scene. The packing itself is read when the run begins. If the key `pressure` is missing, the run begins with the
/// stresses of the state. Faults are recorded if the file is not a state file; if it has another unit system, dimension
/// or checksum than expected; if its cell is rotated; and if there are too many grains.
/// @param t  table [assembly]
/// @param directory  directory to which the name of the state file is relative
/// @param scene  scene that is completed
/// @pre the contact law of the scene has been read
void read_saved_start(TableReader& t, const std::string& directory, Scene& scene);

}  // namespace floc
