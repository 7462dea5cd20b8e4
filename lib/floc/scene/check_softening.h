#pragma once

#include "floc/scene/scene.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Checks the softening of springs wherever a scene gives it, and records a fault where it is not possible: for
/// packings between walls, for stages that impose a length, together with [accuracy], and for contacts that are too
/// soft for it (softening_limit()).
/// (softening_limit()).
/// @param root  reader of the root table of the scene
void check_softening(TableReader& root, const SceneSource& source, const Scene& scene);

}  // namespace floc
