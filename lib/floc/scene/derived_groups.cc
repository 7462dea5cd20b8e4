#include "floc/scene/derived_groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "floc/assembly/size_classes.h"
#include "floc/contact/law_description.h"
#include "floc/contact/law_parameters.h"
#include "floc/loading/run_plan.h"
#include "floc/packing/liquid/liquid.h"
#include "floc/relaxation/dynamics.h"
#include "floc/scene/cost_model.h"
#include "floc/scene/rigid_groups.h"
#include "floc/scene/scene_kind.h"
#include "floc/scene/scene_prices.h"
#include "floc/scene/scene_scales.h"

namespace floc {
namespace {

template <int Dim>
double time_step(const Scene& scene) {
  Packing<Dim> smallest;
  smallest.law = scene.law;
  smallest.grains = Grains<Dim>::with_size(1);
  smallest.grains.radius[0] = 0.5 * scene.grains.smallest();
  smallest.grains.mass[0] =
      mass_of(scene, scene.relaxation.equal_masses ? scene.grains.largest() : scene.grains.smallest());
  return time_step_of(smallest, scene.relaxation.time_step, scene.assembly.pressure);
}

int steps_of(const KnownStress& from, const LoadStage& stage) {
  return stage.is_isotropic() && is_isotropic(from)
             ? static_cast<int>(stage_pressures(*from.front(), stage).size())
             : number_of_steps(from, stage);
}

struct Steps {
  int up = 0;    ///< number of equilibria in all stages that `down` does not count
  int down = 0;  ///< number of equilibria in isotropic stages that decrease the pressure
};

Steps count_steps(const Scene& scene) {
  Steps steps;
  KnownStress from = first_stress(scene.assembly, scene.dimension);
  for (const LoadStage& stage : scene.load) {
    const bool down = stage.is_isotropic() && is_isotropic(from) && stage.to < *from.front();
    (down ? steps.down : steps.up) += steps_of(from, stage);
    from = after_stage(from, stage);
  }
  return steps;
}

using Groups = std::vector<DerivedGroup>;

void add_pressures(const Scene& scene, double unit, const char* name, const char* meaning, Groups& groups) {
  groups.push_back(
      {name, scene.assembly.pressure / unit, fmt::format("{}, first pressure of the scene", meaning)});
  KnownStress from = first_stress(scene.assembly, scene.dimension);
  for (const LoadStage& stage : scene.load) {
    const int n = steps_of(from, stage);
    const AxisLoad driven = stage.is_isotropic() ? AxisLoad{AxisLoad::stress, stage.to}
                                                 : stage.axes[static_cast<std::size_t>(stage.axis)];
    const std::string which = stage.is_isotropic() ? "" : fmt::format(" on axis {}", stage.axis + 1);
    const std::string end = fmt::format("end of stage '{}' after {} steps", stage.name, n);
    if (driven.kind == AxisLoad::strain)
      groups.push_back({"strain", driven.end, fmt::format("logarithmic strain{}, {}", which, end)});
    if (stage.shear != 0.0)
      groups.push_back(
          {"strain", stage.shear,
           fmt::format("shear strain of the planes perpendicular to axis {}, {}", stage.axis + 1, end)});
    if (driven.kind == AxisLoad::stress)
      groups.push_back({name, driven.end / unit, fmt::format("{}{}, {}", meaning, which, end)});
    from = after_stage(from, stage);
  }
}

/// Adds the pressures of a scene in units of the stress caused by adhesion, F0/a^(D-1).
void add_reduced_pressures(const Scene& scene, double a, Groups& groups) {
  add_pressures(scene, pull_off_force(scene) / std::pow(a, scene.dimension - 1), "P_star",
                scene.dimension == 2 ? "reduced pressure a P/F0" : "reduced pressure a^2 P/F0", groups);
}

void add_cohesion(const Scene& scene, double a, Groups& groups) {
  const double F0 = pull_off_force(scene);
  const double K_N = std::pow(a, scene.dimension - 1) * scene.law.contact_modulus(scene.dimension, a);
  groups.push_back(
      {"kappa", K_N / F0,
       "a K_N/F0, stiffness number (largest diameter a, normal stiffness K_N, pull-off force F0)"});
  add_reduced_pressures(scene, a, groups);
  groups.push_back(
      {"h0/a", F0 / K_N,
       "overlap of two grains of the largest diameter a under their adhesion alone, divided by a"});
}

/// Adds the dimensionless numbers of the liquid between grains. The numbers of a liquid bridge are computed for two
/// grains of the largest diameter, on the assumption that each grain has three bridges.
void add_liquid(const CapillaryAdhesion& law, double a, Groups& groups) {
  const double share = law.liquid_volume(1.0);
  const double grain = std::numbers::pi / 6.0 * a * a * a;
  const Bridge<> bridge = law.bridge(0.5 * a, 0.5 * a, share * grain / kBridgesPerGrain);
  groups.push_back({"V_l/V_s", share, "volume of the liquid divided by the volume of the grains"});
  groups.push_back(
      {"l/a", 1.0 / (bridge.decay * a),
       "decay length of the force of a liquid bridge, divided by the diameter, with three bridges per grain"});
  groups.push_back(
      {"hm/a", bridge.reach / a,
       "gap at which a liquid bridge breaks, divided by the diameter, with three bridges per grain"});
}

/// Adds the dimensionless numbers of elastic spheres. The overlap of two spheres is proportional to 1/kappa, and the
/// largest pressure between their surfaces to kappa^(-1/2).
void add_spheres(const Scene& scene, Groups& groups) {
  const double E = scene.law.contact_modulus(scene.dimension, scene.grains.largest());
  double highest = scene.assembly.pressure;
  for (const LoadStage& stage : scene.load) {
    highest = std::max(highest, stage.to);
    for (const AxisLoad& axis : stage.axes)
      if (axis.kind == AxisLoad::stress) highest = std::max(highest, axis.end);
  }
  groups.push_back({"kappa", hertz_kappa(scene, scene.assembly.pressure),
                    "stiffness number (E~/P)^(2/3) at the first pressure P of the scene; E~ = E/(1 - nu^2) "
                    "with Young's modulus E and Poisson's ratio nu"});
  groups.push_back({"kappa", hertz_kappa(scene, highest),
                    "stiffness number (E~/P)^(2/3) at the highest pressure P of the scene"});
  add_pressures(scene, E, "P/E~", "pressure P divided by E~", groups);
  // Largest pressure between the surfaces of two grains in a contact with the mean force. The mean force is computed
  // from the pressure with the assumption z Phi = 4 (coordination number z, solid fraction Phi).
  groups.push_back({"p_max/E~", 0.847131 / std::sqrt(hertz_kappa(scene, highest)),
                    "largest pressure between the surfaces of two grains, divided by E~, in a contact with the "
                    "mean force at the highest "
                    "pressure of the scene"});
}

/// Returns a parameter of the contact law in dimensionless form. The name is the symbol of the parameter, followed by
/// the divisor if the parameter has a unit: "D0/a". Returns std::nullopt for parameters that are forces, pressures or
/// volumes, because these serve as units of the other numbers.
/// @param K_N  normal stiffness of a contact
/// @param a  largest diameter
std::optional<DerivedGroup> group_of(const LawNumber& n, double K_N, double a) {
  const std::string& symbol = n.declared->symbol;
  switch (n.declared->unit) {
    case Unit::ratio:
    case Unit::angle:
    case Unit::degrees:
      return DerivedGroup{symbol, *n.value, n.declared->meaning};
    case Unit::length:
      return DerivedGroup{symbol + "/a", *n.value / a, n.declared->meaning};
    case Unit::stiffness:
      return DerivedGroup{symbol + "/K_N", *n.value / K_N, n.declared->meaning};
    case Unit::rolling_stiffness:
      return DerivedGroup{symbol + "/(K_N a^2)", *n.value / (K_N * a * a), n.declared->meaning};
    case Unit::force:
    case Unit::pressure:
    case Unit::volume:
      break;
  }
  return std::nullopt;
}

/// Adds the dimensionless parameters of one component of the contact law.
/// @param slot  key of the component in a scene, for example "friction"
/// @param a  largest diameter
void add_slot(const std::string& slot, const Scene& scene, double a, Groups& groups) {
  LawParameters law = scene.law;
  const double K_N = scene.law.contact_modulus(scene.dimension, a) * std::pow(a, scene.dimension - 2);
  for (const LawNumber& n : numbers_of(law))
    if (n.key.starts_with(slot + "."))
      if (auto group = group_of(n, K_N, a)) groups.push_back(std::move(*group));
}

void add_law(const Scene& scene, double a, Groups& groups) {
  for (const char* slot : {"friction", "rolling", "twisting", "damping"}) add_slot(slot, scene, a, groups);
  const auto& damping = scene.law.parameters().damping;
  if (damping.holds<ViscousDamping>())
    groups.push_back(
        {"zeta", damping_ratio(damping.get<ViscousDamping>().restitution), "fraction of critical damping"});
}

/// Adds the options of the cell in one part of a run (the assembly, or a stage of the load path): the caps on the
/// strain rate of the cell, the mass of the cell, and the softening. An option that has the same value in the other
/// part is left out.
/// @param r  options in this part
/// @param other  options in the part with which `r` is compared
/// @param where  words for this part of the run, for example " at assembly"
void add_cell(const RelaxationOptions& r, const RelaxationOptions& other, const std::string& where,
              Groups& groups) {
  if (r.strain_rate_cap && r.strain_rate_cap != other.strain_rate_cap)
    groups.push_back({"Ia", *r.strain_rate_cap, "cap on the strain rate of the cell in units of 1/T0" + where});
  if (r.inertial_number_cap && r.inertial_number_cap != other.inertial_number_cap)
    groups.push_back({"I", *r.inertial_number_cap, "cap on the inertial number of the cell" + where});
  if (r.cell_mass != other.cell_mass)
    groups.push_back(
        {"cell_mass", r.cell_mass, "mass of the cell's sides divided by the mass of all grains" + where});
  if (r.softening != other.softening)
    groups.push_back(
        {"softening", r.softening, "factor by which springs are softer while a packing collapses" + where});
}

void add_rates(const Scene& scene, double a, double m, Groups& groups) {
  RelaxationOptions nothing;
  nothing.cell_mass = 0.0;
  add_cell(scene.relaxation, nothing, "", groups);
  RelaxationOptions before = scene.relaxation;
  const auto add_part = [&](const CellResponse& cell, const std::string& where) {
    const RelaxationOptions here = cell.applied_to(scene.relaxation);
    add_cell(here, before, where, groups);
    if (cell.time_step)
      groups.push_back({"time_step", time_step_of_scene(scene) * here.time_step / scene.relaxation.time_step,
                        "time step of the motion (time unit of the scene)" + where});
    before = here;
  };
  add_part(scene.assembly.cell, " at assembly");
  for (const LoadStage& stage : scene.load) {
    const std::string where = fmt::format(" during stage '{}'", stage.name);
    add_part(stage.cell, where);
    if (scene.law.is_rigid() && stage.largest_strain() > 0.0)
      groups.push_back({"I_strain", before.contact_dynamics.inertial_number,
                        "inertial number at which the cell is strained" + where});
  }
  if (scene.assembly.agitation > 0.0)
    groups.push_back(
        {"V0/V_star", scene.assembly.agitation,
         scene.law.range() > 0.0 ? "speed of the grains at the start, in units of V* = sqrt(F0 D0/m)"
         : scene.dimension == 3  ? "speed of the grains at the start, in units of V* = sqrt(P a^3/m)"
                                 : "speed of the grains at the start, in units of V* = sqrt(P a^2/m)"});
  if (scene.law.adheres())
    groups.push_back({"T0", std::sqrt(a * m / pull_off_force(scene)),
                      "sqrt(a m/F0), unit of time of the motion of cohesive grains (time unit of the scene)"});
}

/// Returns the natural unit of time T = sqrt(m/(p a^(D-2))) of a compaction between walls, in the time unit of the
/// scene. p is the first pressure, and D is the dimension.
/// @param a  largest diameter
/// @param m  mass of a grain of this diameter
double compaction_time(const Scene& scene, double a, double m) {
  return std::sqrt(m / (scene.assembly.pressure * std::pow(a, scene.dimension - 2)));
}

/// Adds the dimensionless numbers of the gas and the walls of a box.
void add_walls(const Scene& scene, Groups& groups) {
  const BoxOptions& box = *scene.assembly.box;
  if (!scene.starts_from_state()) {
    groups.push_back({"p_k/p", box.kinetic_pressure / scene.assembly.pressure,
                      "kinetic pressure of the gas divided by the first pressure; above 1 the gas pushes the "
                      "walls outwards"});
    if (scene.assembly.solid_fraction > 0.0)
      groups.push_back({"e_i", 1.0 / scene.assembly.solid_fraction - 1.0, "void ratio of the gas"});
  }
  if (any_wall_moves(box, scene.dimension))
    groups.push_back({"m_w/m", box.mass, "mass of a wall divided by the mass of the largest grain"});
  const double F0 = scene.law.pull_off_force();
  groups.push_back({"f_w/F0", F0 > 0.0 ? box.adhesion / F0 : 0.0,
                    "pull-off force of grains from walls divided by the pull-off force between grains"});
  groups.push_back({"mu_w", box.friction, "friction coefficient of the walls"});
}

/// Adds the dimensionless numbers of a dynamic compaction between walls [SVI2024]. These numbers compare the stresses
/// sc = F0/a^(D-1) and se = K_N/a^(D-2) with the pressure (pull-off force F0, normal stiffness K_N, dimension D).
/// @param a  largest diameter
/// @param m  mass of a grain of this diameter
void add_box(const Scene& scene, double a, double m, Groups& groups) {
  const double p = scene.assembly.pressure;
  const double sc = scene.law.pull_off_force() / std::pow(a, scene.dimension - 1);
  const double se = scene.law.contact_modulus(scene.dimension, a);
  groups.push_back({"sc", sc, "F0/a^(D-1), stress caused by the adhesion (unit of pressure of the scene)"});
  groups.push_back({"eta", sc / p, "sc/p, stress caused by the adhesion divided by the first pressure p"});
  groups.push_back({"eta_star", sc / std::sqrt(p * se),
                    "sc/sqrt(p se) with se = K_N/a^(D-2), adhesion relative to impacts; below 1, grains bounce "
                    "off each other"});
  groups.push_back({"sc/se", sc / se,
                    "overlap of two grains under their adhesion alone, divided by the diameter; overlaps above "
                    "0.02 change the void ratio noticeably"});
  groups.push_back({"se/p", se / p,
                    "se/p with se = K_N/a^(D-2), stiffness of the contacts divided by the first pressure p"});
  add_walls(scene, groups);
  groups.push_back({"T", compaction_time(scene, a, m),
                    "sqrt(m/(p a^(D-2))), unit of time of the compaction (time unit of the scene)"});
}

/// For each of several classes of grain size, adds two fractions of the total volume: the fraction in the drawn grains
/// of the class, and the fraction that the size distribution gives for the class.
void add_sizes(const Scene& scene, Groups& groups) {
  // Largest number of grains for which the fractions are computed. With more grains, the fractions of the drawn grains
  // equal those of the distribution to six digits.
  constexpr int kMostGrains = 1'000'000;
  using Kind = DiameterDistribution::Kind;
  const Kind kind = scene.grains.diameter.kind;
  if (kind == Kind::bidisperse || scene.grains.count < 1 || scene.grains.count > kMostGrains) return;
  const auto asked = [](const std::optional<double>& share) {
    return share ? fmt::format("; the distribution gives {:.4g}", *share) : "";
  };
  const char* volume = scene.dimension == 2 ? "area" : "volume";
  for (int k = 0; const SizeClass& c : size_quarters(scene.grains, scene.dimension))
    groups.push_back(
        {fmt::format("V_{}/V", ++k), c.share,
         fmt::format("fraction of the total {} that is in grains with diameters from {:.4g} to {:.4g}{}",
                     volume, c.from, c.to, asked(c.share_asked))});
  if (kind != Kind::sieve) return;
  for (const SizeClass& c : size_classes(scene.grains, scene.dimension))
    groups.push_back(
        {fmt::format("passing({:.4g})", c.to), c.passing,
         fmt::format("fraction of the mass of all grains that passes a sieve of this size; the sieve curve "
                     "gives {:.4g}",
                     c.passing_asked.value_or(c.passing))});
}

/// Adds the pressures and the unit of time of a scene of rigid grains. Rigid contacts have no stiffness with which
/// pressures could be compared. Without adhesion, only the ratios of pressures affect the results.
/// @param a  largest diameter
void add_rigid_contacts(const Scene& scene, double a, Groups& groups) {
  if (scene.law.adheres())
    add_reduced_pressures(scene, a, groups);
  else
    add_pressures(scene, scene.assembly.pressure, "P/P_1", "pressure divided by the first pressure P_1",
                  groups);
  groups.push_back({"T", time_unit_of_rigid_grains(scene),
                    "sqrt(m/(P_1 a^(d-2))), unit of time of the motion (time unit of the scene)"});
}

/// Returns the expected number of time steps of a compaction between walls under one pressure. The number is computed
/// from the longest time that the scene allows (equilibrium.stop_time) or, if the scene gives none, from the usual time
/// for dense packings.
double steps_of_compaction(const Scene& scene) {
  constexpr double kUsual = 30.0;
  const double a = scene.grains.largest();
  return scene.relaxation.compaction.longest.value_or(kUsual) * compaction_time(scene, a, mass_of(scene, a)) /
         time_step_of_scene(scene);
}

/// Returns the normal stiffness K_N of a contact. The stiffness of a contact of spheres increases with the force. For
/// spheres, K_N is therefore the stiffness at the mean force under the first pressure P: 0.665 kappa P a, with the
/// stiffness number kappa and the largest diameter a. This formula assumes z Phi = 4 (coordination number z, solid
/// fraction Phi).
double typical_stiffness(const Scene& scene) {
  const double a = scene.grains.largest(), modulus = scene.law.contact_modulus(scene.dimension, a);
  if (scene.law.force_exponent() == 1.0) return modulus * std::pow(a, scene.dimension - 2);
  return 0.665 * hertz_kappa(scene, scene.assembly.pressure) * scene.assembly.pressure * a;
}

}  // namespace

double hertz_kappa(const Scene& scene, double pressure) {
  return std::pow(scene.law.contact_modulus(scene.dimension, scene.grains.largest()) / pressure, 2.0 / 3.0);
}

double time_step_of_scene(const Scene& scene) {
  if (scene.has_contact_dynamics())
    return scene.relaxation.contact_dynamics.time_step * time_unit_of_rigid_grains(scene);
  return scene.dimension == 2 ? time_step<2>(scene) : time_step<3>(scene);
}

double expected_cost(const Scene& scene) {
  // Processor time per sphere and time step (s), with about two contacts per sphere, on a core of the year 2023.
  constexpr double kSecondsPerGrainStep = 4.3e-8;
  if (scene.has_contact_dynamics()) {
    const Steps stages = count_steps(scene);
    return cost_of_rigid_grains(scene, stages.up + stages.down);
  }
  if (scene.assembly.box) {
    const Steps stages = count_steps(scene);
    return kSecondsPerGrainStep * scene.grains.count * steps_of_compaction(scene) *
           (1 + stages.up + stages.down);
  }
  // Processor times, divided by the processor time of one equilibrium during loading: kAssembly for the assembly of a
  // packing from a gas, kUnloading for one equilibrium during unloading.
  constexpr double kAssembly = 6.0;
  constexpr double kUnloading = 0.25;
  constexpr double kSecondsPerGrainAndStep = 80.0 / (1400.0 * (26.0 + kAssembly));
  // Time step in the run with which kSecondsPerGrainStep was measured, in units of sqrt(m/K_N) (mass m of the largest
  // grain, normal stiffness K_N).
  constexpr double kTimedStep = 0.1;
  // Stiffness number of that run. The number of time steps is proportional to its root.
  constexpr double kTimedStiffness = 1e5;
  const double stiffness = stiffness_number(scene).value_or(kTimedStiffness);
  const double step =
      time_step_of_scene(scene) / std::sqrt(mass_of(scene, scene.grains.largest()) / typical_stiffness(scene));
  const Steps steps = count_steps(scene);
  const double start = scene.starts_from_state() ? 1.0 : kAssembly;
  return kSecondsPerGrainAndStep * scene.grains.count * (start + steps.up + kUnloading * steps.down) *
         std::sqrt(stiffness / kTimedStiffness) * kTimedStep / step;
}

std::vector<DerivedGroup> derived_groups(const Scene& scene, const RunCost& cost) {
  const double a = scene.grains.largest();
  const double m = mass_of(scene, a);
  Groups groups;
  groups.push_back({"N", static_cast<double>(scene.grains.count), "number of grains"});
  groups.push_back(
      {"d_min/a", scene.grains.smallest() / a, "smallest diameter divided by the largest diameter a"});
  add_sizes(scene, groups);
  if (scene.grains.shape) add_shape_groups(scene, groups);
  if (scene.law.is_rigid()) {
    add_rigid_contacts(scene, a, groups);
  } else if (scene.law.adheres()) {
    add_cohesion(scene, a, groups);
    add_slot("adhesion", scene, a, groups);
    if (const CapillaryAdhesion* law = scene.law.liquid()) add_liquid(*law, a, groups);
  } else if (scene.law.force_exponent() != 1.0) {
    add_spheres(scene, groups);
  } else {
    const double K_N = scene.law.contact_modulus(scene.dimension, a);
    groups.push_back(
        {"kappa", K_N / scene.assembly.pressure,
         "stiffness number K_N/P, with the normal stiffness K_N and the first pressure P of the scene"});
    add_pressures(scene, K_N, "P/K_N", "P/K_N", groups);
  }
  add_law(scene, a, groups);
  if (scene.assembly.box && scene.law.is_rigid())
    add_walls(scene, groups);
  else if (scene.assembly.box)
    add_box(scene, a, m, groups);
  else
    add_rates(scene, a, m, groups);
  groups.push_back({"time_step", time_step_of_scene(scene),
                    scene.has_contact_dynamics()
                        ? "longest time step of the motion at the first pressure (time unit of the scene)"
                        : "time step of the motion (time unit of the scene)"});
  const Steps steps = count_steps(scene);
  // In most scenes the assembly makes one equilibrium. The assembly makes two equilibria if the grains are aggregated
  // (first an equilibrium at zero pressure), or if a packing made from a gas is vibrated (an equilibrium before and one
  // after the vibration).
  const bool twice = scene.assembly.protocol == AssemblyOptions::Protocol::aggregation ||
                     (scene.assembly.vibration && !scene.starts_from_state());
  const int assembled = twice ? 2 : 1;
  groups.push_back({"equilibria", static_cast<double>(assembled + steps.up + steps.down),
                    "number of states (equilibria) of the run"});
  groups.push_back(
      {"cost", cost.core_seconds,
       cost.is_priced()
           ? fmt::format("expected processor time on one core (s), by the table of prices of the kind {}",
                         scene_kind(scene))
           : "expected processor time on one core (s), roughly, since no table of prices applies: "
             "within a factor of two under pressures, of ten otherwise"});
  return groups;
}

std::vector<DerivedGroup> derived_groups(const Scene& scene) {
  return derived_groups(scene, cost_of_run(scene));
}

}  // namespace floc
