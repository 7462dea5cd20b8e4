#pragma once

#include "floc/scene/scene.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Reads two keys of the table [assembly] of a scene with walls (table [box]): the solid fraction and the kinetic
/// pressure of the gas from which the packing is made.
void read_boxed_gas(TableReader& assembly, Scene& scene);

/// Reads the table [box] of a scene, which describes walls around the grains. A scene with walls has this table instead
/// of the table [cell], which describes a periodic cell.
/// @pre the tables [assembly] and [grains] have been read
void read_box(TableReader& root, Scene& scene);

/// Reads those keys of the table [equilibrium] that determine when the compaction of grains between walls ends. If the
/// scene has no walls (no table [box]), a fault is recorded for each of these keys.
void read_compaction_end(TableReader& equilibrium, Scene& scene);

}  // namespace floc
