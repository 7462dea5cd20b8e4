#pragma once

#include <string>

#include "floc/scene/scene.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Reads the keys of [assembly] about the state that a scene starts from: `state`, its file; `copies` of it along
/// each axis; and `state_sha256`, which floc writes into the text of a scene. Sets the number, sizes and mass of the
/// grains and the solid fraction of the run in the scene, and a description of the start. The packing itself is read
/// when the run begins. Faults are a file that is not a state; a state with other units, dimension or checksum, or
/// with a cell that is not rectangular; and too many grains.
/// @param t          table [assembly]
/// @param directory  directory that the file is relative to
/// @pre the contact law of the scene has been read
void read_saved_start(TableReader& t, const std::string& directory, Scene& scene);

}  // namespace floc
