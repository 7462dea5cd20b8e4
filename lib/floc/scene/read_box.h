#pragma once

#include "floc/scene/scene.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Reads the keys of the table [assembly] that apply to a scene with walls (table [box]): the solid fraction and the
/// kinetic pressure of the gas from which the packing is made.
void read_boxed_gas(TableReader& assembly, Scene& scene);

/// Reads the table [box], which describes walls around the grains and replaces the table [cell].
/// @pre the tables [assembly] and [grains] have been read
void read_box(TableReader& root, Scene& scene);

/// Reads the keys of the table [equilibrium] that define when the compaction between walls ends. Records a fault for
/// each of these keys if the scene has no table [box].
void read_compaction_end(TableReader& equilibrium, Scene& scene);

}  // namespace floc
