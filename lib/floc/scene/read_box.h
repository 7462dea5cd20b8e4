#pragma once

#include "floc/scene/scene.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Reads the keys of [assembly] that apply to a scene with a [box]: solid fraction and kinetic pressure of the gas.
void read_boxed_gas(TableReader& assembly, Scene& scene);

/// Reads [box]: walls around the grains, in place of [cell].
/// @pre assembly and grains have been read
void read_box(TableReader& root, Scene& scene);

/// Reads the keys of [equilibrium] that define the end of a compaction. Records faults if the scene has no box.
void read_compaction_end(TableReader& equilibrium, Scene& scene);

}  // namespace floc
