#pragma once

#include "floc/scene/scene.h"
#include "floc/scene/scene_source.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Reads the table [accuracy] of a scene: chooses numerical settings whose errors are within the requested errors, and
/// writes these settings into the scene and into its TOML tables. If the table records that settings have already been
/// chosen, nothing is changed. Faults are recorded for numerical settings that the scene gives in addition to
/// [accuracy], and for requested errors that no settings can meet.
/// @param prices  file of a table of prices, see read_scene()
/// @return whether this call has chosen settings
bool read_accuracy(TableReader& root, SceneSource& source, const std::string& prices, Scene& scene);

}  // namespace floc
