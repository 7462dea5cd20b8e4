#pragma once

#include "floc/scene/scene.h"
#include "floc/scene/scene_source.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Reads [accuracy]: chooses settings by what is asked for and writes them into the scene and its source,
/// unless the scene says that this was done. Records faults: settings given beside it, errors below those of
/// the shipped table.
/// @return whether it chose
bool read_accuracy(TableReader& root, SceneSource& source, Scene& scene);

}  // namespace floc
