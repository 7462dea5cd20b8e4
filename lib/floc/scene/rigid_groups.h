#pragma once

#include "floc/scene/derived_groups.h"

namespace floc {

/// Adds numbers about the shapes of the grains: the number of shapes, the volume of the grains divided by the volume of
/// their circumscribed circles or spheres, and the mean aspect ratio.
/// @pre the scene gives shapes
void add_shape_groups(const Scene& scene, std::vector<DerivedGroup>& groups);

/// Returns the natural unit of time T = sqrt(m/(P a^(d-2))) of the motion of rigid grains, in the time unit of the
/// scene. P is the first pressure, m the largest mass, a the largest diameter and d the dimension.
double time_unit_of_rigid_grains(const Scene& scene);

/// Returns the expected processor time of a run of rigid grains on one core (s), correct within about a factor of two.
/// @param n_loaded  number of equilibria after the assembly
double cost_of_rigid_grains(const Scene& scene, int n_loaded);

}  // namespace floc
