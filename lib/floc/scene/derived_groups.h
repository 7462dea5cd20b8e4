#pragma once

#include <string>
#include <vector>

#include "floc/scene/scene.h"

namespace floc {

struct RunCost;

/// Number computed from the parameters of a scene, with its name and a text that gives its meaning. The number is
/// dimensionless unless `meaning` contains a unit.
struct DerivedGroup {
  std::string name;
  double value;
  std::string meaning;
};

/// Returns the numbers that characterize a scene. The list begins with the dimensionless numbers, such as kappa
/// (stiffness), P* (reduced pressure) of every stage, Ia (strain rate), ratios of stiffnesses, D0/a (range of the
/// adhesion), h0/a (overlap caused by adhesion), the fraction of critical damping and V0/V* (speed at the start). The
/// last numbers of the list are the time T0, the time step, the number of equilibria and the expected cost. In the
/// names, a is the largest diameter. The list contains only numbers about effects that occur in the scene.
/// @param cost  expected cost of a run of the scene, see cost_of_run()
std::vector<DerivedGroup> derived_groups(const Scene& scene, const RunCost& cost);
/// Returns the numbers that characterize a scene, with the cost by the tables of prices that are shipped with floc.
std::vector<DerivedGroup> derived_groups(const Scene& scene);

/// Returns the stiffness number kappa = (E~/P)^(2/3) of elastic spheres under a pressure P, with E~ = E/(1 - nu^2)
/// (Young's modulus E, Poisson's ratio nu). The ratio of the overlap of two spheres to their diameter is proportional
/// to 1/kappa.
double hertz_kappa(const Scene& scene, double pressure);

/// Returns the time step of a run of the scene, in the time unit of the scene. The smallest grain determines the time
/// step.
double time_step_of_scene(const Scene& scene);

/// Returns a rough estimate of the processor time of a run on one core (s), correct within about a factor of two.
/// cost_of_run() is better where a table of prices applies; the estimate needs no table. The processor time is
/// proportional to the number of grains, to the number of equilibria, and to the inverse of the time step. An
/// equilibrium during unloading is assumed to take a quarter of the time of an equilibrium during loading, because
/// unloading is nearly elastic. For comparison: a run that aggregates 1400 grains (protocol "aggregation") and loads
/// them in 26 steps takes 150 s on a core of the year 2023.
double expected_cost(const Scene& scene);

}  // namespace floc
