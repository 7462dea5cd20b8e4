#pragma once

#include "floc/scene/scene.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Reads the table [dynamics] of a scene: the method that moves the grains, and the settings of contact dynamics. The
/// scene determines the method: rigid contacts and grains with shapes require contact dynamics, all others smooth
/// dynamics.
/// @pre the tables [contact] and [grains] have been read
void read_dynamics(TableReader& root, const SceneSource& source, Scene& scene);

/// Records a fault for every table and key of a scene that cannot be combined with rigid contacts, or with shapes of
/// grains.
/// @pre all other tables of the scene have been read
void check_rigid(TableReader& root, const SceneSource& source, const Scene& scene);

}  // namespace floc
