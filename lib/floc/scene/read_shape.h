#pragma once

#include <optional>
#include <string>

#include "floc/scene/scene.h"
#include "floc/scene/scene_source.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Reads the table grains.shape of a scene. Values are checked for their types only; check_shapes() checks their
/// ranges.
/// @param grains  table [grains]
/// @param source  scene, in which faults are recorded
/// @param directory  directory to which the name of a file of shapes is relative
/// @return std::nullopt if the scene has no such table, or if faults were found in it
std::optional<ShapeOptions> read_shape(TableReader& grains, const SceneSource& source,
                                       const std::string& directory);

/// Returns the keyword that a scene gives for a kind of shape, for example "polygon".
const char* shape_kind_name(const ShapeOptions& options);

/// Draws the shapes of a scene. Records a fault if the options of the shapes are not valid, or if a gas of these grains
/// cannot have the solid fraction of the scene. Remarks about a file of shapes are added to the scene.
/// @param root  reader of the root table of the scene
/// @pre all other tables of the scene have been read
void check_shapes(TableReader& root, const SceneSource& source, Scene& scene);

}  // namespace floc
