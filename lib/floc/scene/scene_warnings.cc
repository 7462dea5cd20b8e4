#include "floc/scene/scene_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floc/assembly/size_classes.h"
#include "floc/contact/law_parameters.h"
#include "floc/loading/run_plan.h"
#include "floc/packing/liquid/liquid.h"
#include "floc/packing/overlaps.h"
#include "floc/relaxation/static_solver.h"
#include "floc/scene/cost_model.h"
#include "floc/scene/derived_groups.h"
#include "floc/scene/scene_scales.h"

namespace floc {
namespace {

using Warnings = std::vector<std::string>;

/// Smallest net force on a grain that double precision can resolve, in units of the typical force F1. About four
/// contact forces of a few F1 act on a grain, and their rounding errors add up.
constexpr double kRounding = 1e-15;
/// Kinetic energy per grain that remains because of rounding errors, in the unit of the tolerance equilibrium.energy.
/// This energy corresponds to velocities of 1e-12 in the natural unit of velocity.
constexpr double kLeastEnergy = 1e-24;

void warn_of_tolerances(const Scene& scene, Warnings& warnings) {
  const EquilibriumTolerance& t = scene.relaxation.tolerance;
  const double newton = StaticSolverOptions{}.target;
  for (const auto& [key, value] : {std::pair("force", t.force), {"moment", t.moment}, {"stress", t.stress}}) {
    if (value <= kRounding)
      warnings.push_back(fmt::format(
          "equilibrium.{} = {}: this tolerance cannot be reached in double precision, because rounding errors "
          "leave a residual of about {}; each step would continue until it is given up at equilibrium.max_time",
          key, value, kRounding));
    else if (value < newton && !scene.assembly.box && !scene.has_contact_dynamics())
      warnings.push_back(fmt::format(
          "equilibrium.{} = {}: the Newton iteration stops at a residual of {}, which is larger than this "
          "tolerance; unless the residual falls further by chance, a step is given up at equilibrium.max_time",
          key, value, newton));
  }
  if (scene.relaxation.finish == Finish::dynamic && t.energy < kLeastEnergy)
    warnings.push_back(
        fmt::format("equilibrium.energy = {}: with finish = \"dynamic\" rounding errors keep the kinetic "
                    "energy of the grains at about {}, so each step would continue until it is given up at "
                    "equilibrium.max_time",
                    t.energy, kLeastEnergy));
}

/// Returns the largest stress that a stage imposes at its end; 0 if it imposes only strains.
double largest_stress(const LoadStage& stage) {
  if (stage.is_isotropic()) return stage.to;
  double largest = 0.0;
  for (const AxisLoad& axis : stage.axes)
    if (axis.kind == AxisLoad::stress) largest = std::max(largest, axis.end);
  return largest;
}

/// Returns the overlap of two grains of the largest diameter, divided by their radius. The grains are pressed together
/// by their adhesion and by a multiple of the mean contact force. The mean force F is computed from the pressure P = z
/// Phi F/(pi a^(d-1)) with the assumption z Phi = 4 (coordination number z, solid fraction Phi, largest diameter a,
/// dimension d).
/// @param law  contact law
/// @param pressure  pressure P
/// @param times_mean  number by which the mean force is multiplied
double overlap_under(const Scene& scene, const Law& law, double pressure, double times_mean) {
  const double a = scene.grains.largest();
  const double mean = 0.25 * std::numbers::pi * pressure * std::pow(a, scene.dimension - 1);
  const double elastic = times_mean * mean + law.pull_off_force(0.5 * a);
  const PairGeometry<> pair(0.0, 0.25 * a);
  const double overlap = law.parameters().normal.visit([&](const auto& model) {
    if constexpr (requires { model.overlap_at_force(pair, elastic); })
      return model.overlap_at_force(pair, elastic);
    else if constexpr (requires { model.stiffness_at_force(pair, elastic); })
      return elastic / model.stiffness_at_force(pair, elastic);
    else
      return 0.0;  // rigid contacts
  });
  return overlap / (0.5 * a);
}

/// Warns if the grains are so soft that they overlap too far at a pressure of the load path. This happens, for example,
/// if the stiffness is given in other units than the pressure.
void warn_of_overlaps(const Scene& scene, Warnings& warnings) {
  // in a few percent of the contacts, the force is larger than this number times the mean contact force
  constexpr double kLoaded = 3.0;
  if (!(scene.grains.largest() > 0.0)) return;
  Law law = scene.law, softest = law;
  double deepest = overlap_under(scene, law, scene.assembly.pressure, kLoaded), at = scene.assembly.pressure;
  for (const LoadStage& stage : scene.load) {
    for (const auto& [key, value] : stage.set) change_law(law, key, value);
    const double pressure = largest_stress(stage), overlap = overlap_under(scene, law, pressure, kLoaded);
    if (overlap > deepest) deepest = overlap, at = pressure, softest = law;
  }
  if (deepest > kDeepOverlap)
    warnings.push_back(
        fmt::format("contact.normal: at the pressure {} grains in contact would overlap by about {:.2g} of "
                    "their radius under the mean contact force, and by {:.2g} under {} times this force: {}",
                    at, overlap_under(scene, softest, at, 1.0), deepest, kLoaded, question_of_units(softest)));
}

void warn_of_range(const Scene& scene, Warnings& warnings) {
  const double radius = 0.5 * scene.grains.smallest();
  if (scene.law.range() > radius && radius > 0.0)
    warnings.push_back(
        fmt::format("contact.adhesion.range = {}: the range is longer than the smallest radius, {}, so that "
                    "grains attract other grains beyond their nearest neighbours",
                    scene.law.range(), radius));
}

/// Returns the largest water content during a run. A stage of the load path may set a larger water content than that at
/// the beginning.
/// @param at_first  water content at the beginning
double most_water(const Scene& scene, double at_first) {
  double most = at_first;
  for (const LoadStage& stage : scene.load)
    for (const auto& [key, value] : stage.set)
      if (key == "adhesion.water_content") most = std::max(most, value);
  return most;
}

/// Warns if the liquid between grains has effects that users may not expect: if the grains are in fact dry, if liquid
/// bridges merge, and if walls stay dry.
void warn_of_liquid(const Scene& scene, Warnings& warnings) {
  const auto& adhesion = scene.law.parameters().adhesion;
  if (!adhesion.holds<CapillaryAdhesion>()) return;
  CapillaryAdhesion law = adhesion.get<CapillaryAdhesion>();
  law.water_content = most_water(scene, law.water_content);
  if (law.water_content == 0.0)
    warnings.push_back(
        "contact.adhesion.water_content = 0: the grains are dry. With any liquid, however little, they would "
        "attract each other with the full capillary force, which depends on contact.adhesion.gamma but not on "
        "the volume of a liquid bridge");
  else if (!law.acts())
    warnings.push_back(
        "contact.adhesion.contact_angle = 90: at this angle liquid bridges do not attract the grains, which "
        "behave as if they were dry");
  // Largest volume of a liquid bridge between grains of radius R, divided by R^3, up to which the three bridges of a
  // grain do not merge.
  constexpr double kMerging = 0.1;
  const double filled = law.liquid_volume(4.0 / 3.0 * std::numbers::pi) / kBridgesPerGrain;
  if (filled > kMerging)
    warnings.push_back(
        fmt::format("contact.adhesion.water_content = {}: with three liquid bridges per grain each bridge has "
                    "the volume {:.2g} R^3 (R is the radius of a grain), but above {} R^3 bridges merge, which "
                    "this contact law does not describe",
                    law.water_content, filled, kMerging));
  if (scene.assembly.box)
    warnings.push_back(
        "contact.adhesion.law = \"capillary\": contacts of grains with walls are dry; liquid bridges form only "
        "between grains");
}

/// Returns the unit of time sqrt(a m/F1) at a pressure, with the largest diameter a and the mass m of a grain of this
/// diameter. The typical force F1 is the larger of the pull-off force and the pressure times a^(d-1), in d dimensions.
/// Returns 0 if F1 is zero.
double time_unit(const Scene& scene, double pressure) {
  const double a = scene.grains.largest(), m = mass_of(scene, a);
  const double F1 = std::max(pull_off_force(scene), pressure * std::pow(a, scene.dimension - 1));
  return F1 > 0.0 ? std::sqrt(a * m / F1) : 0.0;
}

/// Warns if the compression of a gas takes so long that the grains do not touch before the first equilibrium is given
/// up, at the time equilibrium.max_time.
void warn_of_slow_compression(const Scene& scene, Warnings& warnings) {
  // Smallest solid fraction at which a gas compressed under pressure (protocol "direct") may come to rest, even if its
  // grains adhere.
  const double loosest = scene.dimension == 2 ? 0.5 : 0.35;
  const bool gas = scene.assembly.protocol == AssemblyOptions::Protocol::direct;
  const double phi = scene.assembly.solid_fraction, pressure = scene.assembly.pressure;
  if (!gas || !(phi > 0.0) || phi >= loosest || !(pressure > 0.0)) return;
  const double unit = time_unit(scene, pressure);
  const RelaxationOptions r = scene.assembly.cell.applied_to(scene.relaxation);
  // strain_rate_cap is given as a strain rate times `free_unit`; inertial_number_cap as a strain rate times sqrt(m/P)
  // for disks, or times sqrt(m/(P a)) for spheres. Both square roots equal sqrt(a m/F1) if the pressure P determines
  // the typical force F1.
  const double free_unit = scene.law.adheres() ? time_unit(scene, 0.0) : unit;
  const double rate = r.strain_rate_cap       ? *r.strain_rate_cap / free_unit
                      : r.inertial_number_cap ? *r.inertial_number_cap / unit
                                              : 0.0;
  if (!(rate > 0.0) || !(unit > 0.0)) return;
  const double least = std::log(loosest / phi) / (scene.dimension * rate) / unit;
  if (least > r.max_time)
    warnings.push_back(
        fmt::format("cell.{} = {}: at this strain rate the compression of the gas from solid_fraction = {} "
                    "takes at least {:.3g} units of time sqrt(a m/F1) (largest diameter a, its mass m, typical "
                    "force F1), but a step is given up after equilibrium.max_time = {}",
                    r.strain_rate_cap ? "strain_rate_cap" : "inertial_number_cap",
                    r.strain_rate_cap ? *r.strain_rate_cap : *r.inertial_number_cap, phi, least, r.max_time));
}

/// Returns the side of a square or cubic cell that contains all grains of a scene in a dense packing, in units of the
/// largest diameter.
double packed_side(const Scene& scene) {
  const double densest = scene.dimension == 2 ? 0.8 : 0.6;
  const double unit_volume = scene.dimension == 2 ? std::numbers::pi / 4.0 : std::numbers::pi / 6.0;
  return std::pow(scene.grains.count * unit_volume / densest, 1.0 / scene.dimension);
}

/// Returns the mass of the smallest grain, divided by the mass of the largest grain.
double lightest(const Scene& scene) {
  return std::pow(scene.grains.smallest() / scene.grains.largest(), scene.dimension);
}

/// Warns if the cell is so light that the time step must be much smaller than for the grains alone. A cell that is
/// lighter than a few grains vibrates faster than the grains (see cell_time_step_of()).
void warn_of_light_cell(const Scene& scene, Warnings& warnings) {
  // Implicit time steps are stable with cells of any mass.
  if (scene.assembly.box || scene.has_contact_dynamics()) return;
  // there is a warning if the time step, divided by the time step that the grains alone allow, is below this number
  constexpr double kSlow = 0.1;
  const double along = scene.dimension == 2 ? 1.5 : 2.0;
  const auto check = [&](const std::string& key, const CellResponse& cell) {
    const double mass = cell.applied_to(scene.relaxation).cell_mass;
    const double share = packed_side(scene) * std::sqrt(mass / (along * lightest(scene)));
    if (share >= kSlow) return false;
    warnings.push_back(fmt::format(
        "{} = {:g}: such a light cell vibrates faster than the grains, so that the time step is "
        "only {:.1e} times the time step that the grains alone allow; expected a mass of at least {:.1e}",
        key, mass, share, mass * std::pow(kSlow / share, 2)));
    return true;
  };
  if (check("cell.mass", scene.assembly.cell)) return;
  for (std::size_t k = 0; k < scene.load.size(); ++k)
    if (check(scene.load[k].cell.cell_mass ? fmt::format("load.{}.cell_mass", k) : "cell.mass",
              scene.load[k].cell))
      return;
}

/// Warns if the walls are so light that their motion diverges. The time step is chosen for the grains alone, and may be
/// too long for light walls.
void warn_of_light_walls(const Scene& scene, Warnings& warnings) {
  // Contact dynamics solves the motion of a wall together with the impulses of its contacts, so that it cannot diverge.
  if (!scene.assembly.box || scene.has_contact_dynamics()) return;
  // A wall is touched by about two thirds of the grains that fit side by side along it. The motion of the wall diverges
  // if dt w > 2, with the time step dt and the frequency w of the wall: w^2 = n K/M, with the number n of touching
  // grains, the contact stiffness K and the mass M of the wall.
  const double n_touching = 2.0 / 3.0 * std::pow(packed_side(scene), scene.dimension - 1);
  const double step = scene.relaxation.time_step * (scene.dimension == 2 ? 1.0 : 0.775);
  const double least = n_touching * lightest(scene) * std::pow(0.5 * step, 2);
  if (scene.assembly.box->mass < least)
    warnings.push_back(
        fmt::format("box.mass = {:g}: walls of such a small mass vibrate too fast for the time step, and their "
                    "motion diverges; expected a mass above {:.2g}, or a smaller run.time_step",
                    scene.assembly.box->mass, least));
}

/// Warns of elastic grains with corners whose contact forces do not change continuously with their positions: sharp
/// corners, and polyhedra whose faces touch.
void warn_of_elastic_corners(const Scene& scene, Warnings& warnings) {
  const auto& shape = scene.grains.shape;
  if (!shape || scene.law.is_rigid() || std::holds_alternative<FileShapeOptions>(shape->kind) ||
      std::holds_alternative<CapsuleOptions>(shape->kind))
    return;
  if (shape->rounding == 0.0)
    warnings.emplace_back(
        "grains.shape.rounding = 0: the force between sharp corners jumps when other corners come into "
        "contact, so that elastic grains may find no rest; expected a rounding wider than the overlaps, such "
        "as 0.05");
  if (scene.dimension == 3 && scene.law.friction_coefficient() == 0.0)
    warnings.emplace_back(
        "grains.shape: contact points between two faces appear and vanish abruptly as the faces move, so that "
        "elastic polyhedra without friction often find no rest; expected friction, or rigid contacts");
}

/// Warns if contacts are so stiff relative to the load that the motion into equilibrium takes very many time steps.
/// Only spheres are checked: their forces depend on the path, so Newton steps without motion cannot find their
/// equilibria.
void warn_of_stiff_contacts(const Scene& scene, Warnings& warnings) {
  // Largest number of time steps per unit of time sqrt(a m/F1) for which there is no warning: twice the largest number
  // in the scenes shipped with floc.
  constexpr double kMany = 3000.0;
  if (scene.law.force_exponent() == 1.0) return;
  const double pressure = scene.assembly.pressure;
  const double unit = time_unit(scene, pressure);
  const double step = time_step_of_scene(scene);
  if (!(unit > 0.0) || !(step > 0.0) || unit / step < kMany) return;
  warnings.push_back(
      fmt::format("contact.normal: relative to the load the contacts are so stiff that a unit of time "
                  "sqrt(a m/F1) (largest diameter a, its mass m, typical force F1) takes {:.1e} time steps, "
                  "and every state takes several hundred units of time; expected softer contacts (results "
                  "hardly depend on the stiffness if the "
                  "stiffness number kappa is above 1e5) or a higher pressure than assembly.pressure = {:g}",
                  unit / step, pressure));
}

void warn_of_no_sticking(const Scene& scene, Warnings& warnings) {
  const bool sticks = scene.law.has_damping() || scene.law.has_friction();
  if (scene.assembly.protocol == AssemblyOptions::Protocol::aggregation && !sticks)
    warnings.push_back(
        "assembly.protocol = \"aggregation\": without contact.damping and contact.friction collisions "
        "dissipate no energy, so that grains separate again; expected one of these tables");
}

/// Warns if a single grain makes up much of the volume of all grains. The diameters are equally spaced quantiles,
/// including both ends of the distribution, so one grain always has the largest diameter, even if this diameter is very
/// rare in the distribution.
void warn_of_largest_grain(const Scene& scene, Warnings& warnings) {
  constexpr double kMuch = 0.05;
  const DiameterDistribution& d = scene.grains.diameter;
  if (scene.starts_from_state() || scene.grains.count < 1) return;
  if (d.kind != DiameterDistribution::Kind::power_law && d.kind != DiameterDistribution::Kind::lognormal)
    return;
  if (d.quantiles == DiameterDistribution::Quantiles::middle) return;
  double sum = 0.0;
  for (const double diameter : equally_spaced_diameters(d, scene.grains.count))
    sum += std::pow(diameter / d.max, scene.dimension);
  if (1.0 / sum > kMuch)
    warnings.push_back(
        fmt::format("grains.diameter: the largest of the {} grains has {:.2g} % of their total {}, more than "
                    "the distribution gives for this size, because a grain of the largest diameter is always "
                    "included; expected more grains, or grains.diameter.quantiles = \"middle\"",
                    scene.grains.count, 100.0 / sum, scene.dimension == 2 ? "area" : "volume"));
}

/// Warns if the volumes of the drawn grains differ from the volumes that the size distribution gives. This happens if
/// large grains are rare and the diameters are quantiles in the middle of equal fractions of the grains: there may be
/// no large grain, or one large grain whose fraction of the volume is too large.
void warn_of_sizes(const Scene& scene, Warnings& warnings) {
  constexpr double kMuch = 0.02;
  if (scene.grains.diameter.quantiles != DiameterDistribution::Quantiles::middle || scene.grains.count < 1)
    return;
  const SizeClass* worst = nullptr;
  const auto error = [](const SizeClass& c) {
    return std::abs(c.passing - c.passing_asked.value_or(c.passing));
  };
  const std::vector<SizeClass> classes = size_classes(scene.grains, scene.dimension);
  for (const SizeClass& c : classes)
    if (!worst || error(c) > error(*worst)) worst = &c;
  if (worst && error(*worst) > kMuch)
    warnings.push_back(
        fmt::format("grains.diameter: of the {} grains, those with diameters up to {:.4g} have {:.3g} % of the "
                    "total {}, but the "
                    "size distribution gives {:.3g} %, because there are too few large grains; expected more "
                    "grains, or a larger "
                    "smallest diameter (grains.diameter.min)",
                    scene.grains.count, worst->to, 100.0 * worst->passing,
                    scene.dimension == 2 ? "area" : "volume", 100.0 * *worst->passing_asked));
}

void warn_of_cost(const Scene& scene, Warnings& warnings) {
  constexpr double kDay = 86400.0, kLong = 30.0 * kDay;
  // The rough estimate is correct within a factor of ten, so most scenes need no table of prices here.
  if (expected_cost(scene) < 0.01 * kLong) return;
  if (const double cost = cost_of_run(scene).core_seconds; cost > kLong)
    warnings.push_back(fmt::format("the run is expected to take {:.3g} days on one core", cost / kDay));
}

}  // namespace

std::vector<std::string> scene_warnings(const Scene& scene) {
  Warnings warnings = scene.remarks;
  warn_of_tolerances(scene, warnings);
  warn_of_overlaps(scene, warnings);
  warn_of_largest_grain(scene, warnings);
  warn_of_sizes(scene, warnings);
  warn_of_range(scene, warnings);
  warn_of_liquid(scene, warnings);
  warn_of_slow_compression(scene, warnings);
  warn_of_light_cell(scene, warnings);
  warn_of_light_walls(scene, warnings);
  warn_of_stiff_contacts(scene, warnings);
  warn_of_elastic_corners(scene, warnings);
  warn_of_no_sticking(scene, warnings);
  warn_of_cost(scene, warnings);
  return warnings;
}

}  // namespace floc
