#pragma once

#include <string>
#include <vector>

#include "floc/scene/scene.h"

namespace floc {

/// A number that follows from a scene; it is dimensionless unless its meaning gives a unit.
struct DerivedGroup {
  std::string name;
  double value;
  std::string meaning;
};

/// Returns the dimensionless groups of a scene: kappa, P* of every stage, Ia, stiffness ratios, D0/a, h0/a, fraction
/// of critical damping, V0/V*; then T0, the time step, the number of equilibria and the expected cost. The length a
/// is the largest diameter, and m the mass of a grain of that size. Groups of physics that the scene lacks are
/// omitted.
std::vector<DerivedGroup> derived_groups(const Scene& scene);

/// Returns kappa = (E~/P)^(2/3), E~ = E/(1 - nu^2), of elastic spheres under a pressure; overlaps scale as 1/kappa.
double hertz_kappa(const Scene& scene, double pressure);

/// Returns the time step of a run (time unit of the scene), which its smallest grain determines.
double time_step_of_scene(const Scene& scene);

/// Returns the expected cost of a run on one core (s), to about a factor of two. It is proportional to the number of
/// grains, to the number of equilibria (unloading is nearly elastic and counts a quarter) and to the inverse of the
/// time step; N = 1400 of type 2 with 26 loading steps takes 150 s on a core of 2023.
double expected_cost(const Scene& scene);

}  // namespace floc
