#pragma once

#include "floc/scene/scene.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Records a fault for every softening of a scene that is not possible: of packings between walls, of stages that impose
/// a length, beside [accuracy], and of contacts that are too soft for it (softening_limit()).
/// @param root  reader of the root table of the scene
void check_softening(TableReader& root, const SceneSource& source, const Scene& scene);

}  // namespace floc
