#pragma once

#include "floc/scene/scene.h"
#include "floc/scene/scene_source.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Reads [accuracy]: chooses numerical settings for the requested errors and writes them into the scene and its
/// source, unless the scene records that this was done before. Settings given beside [accuracy], and errors below
/// those of the shipped table, are faults.
/// @return whether settings were chosen
bool read_accuracy(TableReader& root, SceneSource& source, Scene& scene);

}  // namespace floc
