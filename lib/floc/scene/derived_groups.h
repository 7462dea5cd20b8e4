#pragma once

#include <string>
#include <vector>

#include "floc/scene/scene.h"

namespace floc {

/// A number computed from the parameters of a scene. It is dimensionless unless `meaning` gives a unit.
struct DerivedGroup {
  std::string name;
  double value;
  std::string meaning;
};

/// Returns the dimensionless numbers of a scene: kappa (stiffness), P* (reduced pressure) of every stage, Ia (strain
/// rate), stiffness ratios, D0/a (range of the adhesion), h0/a (overlap by adhesion), fraction of critical damping,
/// V0/V* (agitation); then the time T0, the time step, the number of equilibria and the expected cost. The length a is
/// the largest diameter, and m is the mass of a grain of this diameter. Numbers of physics that the scene does not use
/// are omitted.
std::vector<DerivedGroup> derived_groups(const Scene& scene);

/// Returns the stiffness number kappa = (E~/P)^(2/3) of elastic spheres under the pressure P, where E~ = E/(1 - nu^2).
/// Overlaps are proportional to 1/kappa.
double hertz_kappa(const Scene& scene, double pressure);

/// Returns the time step of a run (time unit of the scene). The smallest grain determines it.
double time_step_of_scene(const Scene& scene);

/// Returns the expected processor time of a run on one core (s), within about a factor of two. It is proportional to
/// the number of grains, to the number of equilibria (one equilibrium of unloading counts a quarter, because unloading
/// is nearly elastic) and to the inverse of the time step. For reference, a run of 1400 grains that are aggregated
/// (protocol "aggregation") and loaded in 26 steps takes 150 s on a core of 2023.
double expected_cost(const Scene& scene);

}  // namespace floc
