#pragma once

#include "floc/scene/scene.h"
#include "floc/scene/scene_source.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Reads the table [accuracy]: chooses numerical settings for the requested errors, and writes them into the scene and
/// into its text, unless the scene records that this was done before. Faults are recorded for settings that the scene
/// gives in addition to [accuracy], and for requested errors below those of the table shipped with floc.
/// @return whether settings were chosen
bool read_accuracy(TableReader& root, SceneSource& source, Scene& scene);

}  // namespace floc
