#pragma once

#include "floc/scene/scene.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Checks the time step of each part of a run that gives its own (assembly.time_step, load.time_step), and records a
/// fault for each one that is not possible. Grains with friction, or with resistance to rolling or twisting, may not have
/// a step of kStableStep or more. A time step cannot be given together with the table [accuracy], nor in a scene that
/// contact dynamics moves.
/// @param root  reader of the root table of the scene
void check_time_steps(TableReader& root, const SceneSource& source, const Scene& scene);

}  // namespace floc
