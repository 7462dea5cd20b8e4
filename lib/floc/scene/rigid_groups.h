#pragma once

#include "floc/scene/derived_groups.h"

namespace floc {

/// Adds numbers about the shapes of the grains: the number of shapes, the volume of the grains divided by the volume of
/// their circumscribed circles or spheres, and the mean aspect ratio.
/// @pre the scene gives shapes
void add_shape_groups(const Scene& scene, std::vector<DerivedGroup>& groups);

/// Returns T = sqrt(m/(P a^(d-2))), the unit of time of the motion of rigid grains, with the first pressure P, the
/// largest mass m, the largest diameter a and the dimension d (time unit of the scene).
double time_unit_of_rigid_grains(const Scene& scene);

/// Returns the expected processor time of a run of rigid grains on one core (s), correct within about a factor of two.
/// @param n_loaded  number of equilibria after the assembly
double cost_of_rigid_grains(const Scene& scene, int n_loaded);

}  // namespace floc
