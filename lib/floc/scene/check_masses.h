#pragma once

#include <string>

#include "floc/scene/scene.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Returns the reason why the grains of a run cannot move with equal masses; empty if they can. They cannot if the
/// equilibrium depends on the masses or if contact dynamics moves the grains.
std::string equal_masses_fault(const RunOptions& run);

/// Records a fault if the scene gives its grains equal masses (equilibrium.masses) where this is not possible.
/// @param root  reader of the root table of the scene
void check_masses(TableReader& root, const Scene& scene);

}  // namespace floc
