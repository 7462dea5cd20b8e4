#pragma once

#include <string>

#include "floc/scene/scene.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Reads the keys of the table [assembly] that describe the saved state from which a run starts: `state`, its file;
/// `copies`, the number of copies of it along each axis; and `state_sha256`, its checksum, which floc writes into the
/// text of a scene. Sets the number, sizes and density of the grains, the solid fraction and a description of the start
/// in the scene. The packing itself is read when the run begins. Faults are recorded for a file that is not a state,
/// for a state with another unit system, dimension or checksum or with a cell that is not rectangular, and for too many
/// grains.
/// @param t  table [assembly]
/// @param directory  directory to which the name of the state file is relative
/// @param scene  scene to be completed
/// @pre the contact law of the scene has been read
void read_saved_start(TableReader& t, const std::string& directory, Scene& scene);

}  // namespace floc
