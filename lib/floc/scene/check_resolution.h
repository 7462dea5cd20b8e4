#pragma once

#include "floc/scene/scene.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Records a fault in a scene whose results would not be accurate for one of these reasons: a pressure is not larger
/// than the tolerance of a stress; contacts are so stiff that rounding errors exceed the tolerances; grains are so soft
/// that they overlap too far.
/// @param root  reader of the root table of the scene
void check_resolution(TableReader& root, const Scene& scene);

}  // namespace floc
