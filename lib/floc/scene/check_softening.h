#pragma once

#include "floc/scene/scene.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Checks every softening of springs that a scene gives, and records a fault for each one that is not possible. Springs
/// cannot be softened in a packing between walls, in a stage that imposes a strain, or if the contacts are already too
/// soft (see softening_limit()). A softening cannot be given together with the table [accuracy].
/// @param root  reader of the root table of the scene
void check_softening(TableReader& root, const SceneSource& source, const Scene& scene);

}  // namespace floc
