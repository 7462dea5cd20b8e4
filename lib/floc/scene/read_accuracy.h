#pragma once

#include "floc/scene/scene.h"
#include "floc/scene/scene_source.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Reads [accuracy]: chooses settings for the errors asked for and writes them into the scene and its source,
/// unless the scene says that this was done. Records as faults any settings given beside it, and errors below
/// those of the shipped table.
/// @return whether it chose
bool read_accuracy(TableReader& root, SceneSource& source, Scene& scene);

}  // namespace floc
