#pragma once

#include <string>

#include "floc/scene/scene.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Reads what [assembly] says about the state that a scene starts from: `state`, its file, `copies` of it along
/// each axis, and `state_sha256`, which floc writes into the text of a scene. The scene gets the number, sizes
/// and mass of the grains, and the solid fraction, that the run will have, and a description of what it starts
/// from; the packing itself is read again when the run begins. Faults: a file that is not a state, or a state
/// of the wrong units, dimension or checksum, or in a cell that is not rectangular; too many grains.
/// @param t          the table [assembly]
/// @param directory  where the file is looked for
/// @pre the contact law of the scene is read
void read_saved_start(TableReader& t, const std::string& directory, Scene& scene);

}  // namespace floc
