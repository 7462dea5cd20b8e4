#pragma once

#include "floc/scene/scene.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Records a fault for each of these reasons why the results of a scene would not be accurate: a pressure is not larger
/// than the tolerance of a stress; contacts are so stiff that rounding errors exceed the tolerances; grains are so soft
/// that they overlap too far.
/// @param root  reader of the root table of the scene
void check_resolution(TableReader& root, const Scene& scene);

/// Returns the value of equilibrium.stress from which on check_resolution() refuses a pressure of a scene; infinite if it
/// refuses none.
double stress_tolerance_limit(const Scene& scene);

}  // namespace floc
