#include "floc/scene/derived_groups.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "floc/contact/damping/viscous_damping.h"
#include "floc/relaxation/dynamics.h"

namespace floc {
namespace {

double mass_of(const Scene& scene, double diameter) {
  return scene.grains.density.value_or(4.0 / std::numbers::pi) * std::numbers::pi / 4.0 * diameter * diameter;
}

/// Time step of the run (time unit of the scene): the smallest grain sets it.
double time_step(const Scene& scene) {
  Packing<2> smallest;
  smallest.law = scene.law;
  smallest.grains = Grains<2>::with_size(1);
  smallest.grains.radius[0] = 0.5 * scene.grains.diameter.min;
  smallest.grains.mass[0] = mass_of(scene, scene.grains.diameter.min);
  return time_step_of(smallest, scene.relaxation.time_step);
}

struct Steps {
  int up = 0;  ///< including holds
  int down = 0;
};

Steps count_steps(const Scene& scene) {
  Steps steps;
  double from = scene.assembly.pressure;
  for (const LoadTurn& turn : scene.load) {
    const int n = static_cast<int>(turn_pressures(from, turn).size());
    (turn.to < from ? steps.down : steps.up) += n;
    from = turn.to;
  }
  return steps;
}

using Groups = std::vector<DerivedGroup>;

void add_pressures(const Scene& scene, double unit, const char* name, const char* meaning, Groups& groups) {
  groups.push_back({name, scene.assembly.pressure / unit, fmt::format("{}, first pressure", meaning)});
  double from = scene.assembly.pressure;
  for (const LoadTurn& turn : scene.load) {
    groups.push_back(
        {name, turn.to / unit,
         fmt::format("{}, end of '{}' after {} steps", meaning, turn.name, turn_pressures(from, turn).size())});
    from = turn.to;
  }
}

void add_cohesion(const Scene& scene, double a, Groups& groups) {
  const LawParameters& law = scene.law;
  const double F0 = law.adhesion->force;
  groups.push_back(
      {"kappa", a * law.normal_stiffness / F0, "a K_N/F0, stiffness of a contact against adhesion"});
  add_pressures(scene, F0 / a, "P_star", "a P/F0", groups);
  groups.push_back({"h0/a", F0 / (law.normal_stiffness * a), "overlap of a free pair"});
  if (law.adhesion->range > 0) groups.push_back({"D0/a", law.adhesion->range / a, "range of the attraction"});
}

void add_springs(const LawParameters& law, double a, Groups& groups) {
  const double K_N = law.normal_stiffness;
  if (law.friction) {
    groups.push_back({"mu", law.friction->coefficient, "friction coefficient"});
    groups.push_back({"K_T/K_N", law.friction->stiffness / K_N, "tangential stiffness"});
  }
  if (law.rolling) {
    groups.push_back({"mu_R/a", law.rolling->coefficient / a, "rolling friction"});
    groups.push_back({"K_R/(K_N a^2)", law.rolling->stiffness / (K_N * a * a), "rolling stiffness"});
  }
  if (law.damping) {
    groups.push_back({"e_N", law.damping->restitution, "restitution coefficient"});
    groups.push_back({"zeta", damping_ratio(law.damping->restitution), "fraction of critical damping"});
  }
}

void add_rates(const Scene& scene, double a, double m, Groups& groups) {
  const RelaxationOptions& r = scene.relaxation;
  if (r.strain_rate_cap) groups.push_back({"Ia", *r.strain_rate_cap, "cap on the strain rate in 1/T0"});
  if (r.inertial_number_cap)
    groups.push_back({"I", *r.inertial_number_cap, "cap on the inertial number of the strain rate"});
  groups.push_back({"cell_mass", r.cell_mass, "mass of the cell's sides over that of the grains"});
  if (scene.assembly.agitation > 0.0)
    groups.push_back({"V0/V_star", scene.assembly.agitation,
                      scene.law.range() > 0.0 ? "agitation at the start, V* = sqrt(F0 D0/m)"
                                              : "agitation at the start, V* = sqrt(P a^2/m)"});
  if (scene.law.adhesion)
    groups.push_back(
        {"T0", std::sqrt(a * m / scene.law.adhesion->force), "sqrt(a m/F0), unit of time of the scene"});
}

}  // namespace

double expected_cost(const Scene& scene) {
  // What assembling a gas costs, in loading steps.
  constexpr double kAssembly = 6.0;
  constexpr double kUnloading = 0.25;
  constexpr double kSecondsPerGrainAndStep = 80.0 / (1400.0 * (26.0 + kAssembly));
  // The step of the scene that was timed, in sqrt(m/K_N).
  constexpr double kTimedStep = 0.1;
  const double step =
      time_step(scene) / std::sqrt(mass_of(scene, scene.grains.diameter.max) / scene.law.normal_stiffness);
  const Steps steps = count_steps(scene);
  const double start = scene.starts_from_state() ? 1.0 : kAssembly;
  return kSecondsPerGrainAndStep * scene.grains.count * (start + steps.up + kUnloading * steps.down) *
         kTimedStep / step;
}

std::vector<DerivedGroup> derived_groups(const Scene& scene) {
  const double a = scene.grains.diameter.max;
  const double m = mass_of(scene, a);
  Groups groups;
  groups.push_back({"N", static_cast<double>(scene.grains.count), "grains"});
  groups.push_back({"d_min/a", scene.grains.diameter.min / a, "smallest diameter over the largest, a"});
  if (scene.law.adhesion) {
    add_cohesion(scene, a, groups);
  } else {
    groups.push_back(
        {"kappa", scene.law.normal_stiffness / scene.assembly.pressure, "K_N/P at the first pressure"});
    add_pressures(scene, scene.law.normal_stiffness, "P/K_N", "P/K_N", groups);
  }
  add_springs(scene.law, a, groups);
  add_rates(scene, a, m, groups);
  groups.push_back({"time_step", time_step(scene), "step of the dynamics (time unit of the scene)"});
  const Steps steps = count_steps(scene);
  // Aggregation is equilibrated without pressure first.
  const int assembled = scene.assembly.protocol == AssemblyOptions::Protocol::aggregation ? 2 : 1;
  groups.push_back(
      {"equilibria", static_cast<double>(assembled + steps.up + steps.down), "states of the path"});
  groups.push_back({"cost", expected_cost(scene), "expected, seconds on one core; to a factor of two"});
  return groups;
}

}  // namespace floc
