#pragma once

#include "floc/scene/scene.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Reads the table [dynamics] of a scene: the method by which its grains are moved, and the settings of contact
/// dynamics. The method follows from the contacts: rigid contacts require contact dynamics, all others smooth dynamics.
/// @pre the table [contact] has been read
void read_dynamics(TableReader& root, const SceneSource& source, Scene& scene);

/// Records a fault for every table and key of a scene that is not possible with rigid contacts or with shapes of
/// grains.
/// @pre all other tables of the scene have been read
void check_rigid(TableReader& root, const SceneSource& source, const Scene& scene);

}  // namespace floc
