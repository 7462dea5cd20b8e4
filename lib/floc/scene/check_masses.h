#pragma once

#include "floc/scene/scene.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Returns whether the grains of a run can move with equal masses. They cannot under gravity, where the equilibrium
/// depends on the masses, or if contact dynamics moves them.
bool allows_equal_masses(const RunOptions& run);

/// Records a fault if the scene gives its grains equal masses (equilibrium.masses) although it has gravity. For contact
/// dynamics, check_rigid() records the fault.
/// @param root  reader of the root table of the scene
void check_masses(TableReader& root, const Scene& scene);

}  // namespace floc
