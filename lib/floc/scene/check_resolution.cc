#include "floc/scene/check_resolution.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "floc/scene/derived_groups.h"
#include "floc/scene/scene_scales.h"

namespace floc {
namespace {

using Need = TableReader::Need;

/// Returns the stresses that a stage imposes at its end, each with the name of the key in the scene that gives the
/// stress.
std::vector<std::pair<const char*, double>> stresses_of(const LoadStage& stage) {
  if (stage.is_isotropic()) return {{stage.control == "axes" ? "axes" : "to", stage.to}};
  std::vector<std::pair<const char*, double>> stresses;
  for (const AxisLoad& axis : stage.axes)
    if (axis.kind == AxisLoad::stress) stresses.emplace_back(stage.control == "axes" ? "axes" : "to", axis.end);
  return stresses;
}

/// Calls check(table, key, pressure) for every imposed pressure or stress of a scene in order: for the pressure of the
/// assembly, then for the stresses at the ends of the stages. `key` is the key of the scene that gives the value. Stops
/// before the first stage for which ends(stage) is true.
template <class Check, class Ends>
void for_each_pressure(TableReader& root, const Scene& scene, const Check& check, const Ends& ends) {
  TableReader assembly = root.table("assembly", "", Need::optional);
  if (assembly) check(assembly, "pressure", scene.assembly.pressure);
  if (scene.load.empty()) return;
  std::vector<TableReader> stages = root.tables("load", "tables [[load]]");
  for (std::size_t k = 0; k < std::min(stages.size(), scene.load.size()) && !ends(scene.load[k]); ++k)
    for (const auto& [key, stress] : stresses_of(scene.load[k])) check(stages[k], key, stress);
}

/// Returns whether the tolerance of a stress is proportional to the pull-off force, so that small pressures may be below
/// it.
bool has_least_pressure(const Scene& scene) {
  return scene.law.adheres() && !scene.assembly.box && scene.grains.largest() > 0;
}

/// Returns the unit of the tolerance of a stress: the pull-off force per area (length in 2D) of a largest grain.
double unit_of_tolerance(const Scene& scene) {
  return pull_off_force(scene) / std::pow(scene.grains.largest(), scene.dimension - 1);
}

/// Returns whether a stage changes the pull-off force, to which the tolerance of a stress is proportional. Then neither
/// the stage nor the later stages are checked.
bool changes_pull_off_force(const LoadStage& stage) {
  return std::ranges::any_of(stage.set, [](const auto& change) { return change.first == "adhesion.force"; });
}

/// Records a fault for every pressure that is not larger than the tolerance of a stress, because such a pressure cannot
/// be distinguished from zero.
void check_pressures(TableReader& root, const Scene& scene) {
  if (!has_least_pressure(scene)) return;
  const double least = scene.relaxation.tolerance.stress * unit_of_tolerance(scene);
  const auto check = [&](TableReader& t, const char* key, double pressure) {
    if (pressure > 0 && pressure <= least)
      t.fault(
          key,
          fmt::format(
              "{} = {}: this pressure is not larger than the accepted error of a stress, equilibrium.stress * "
              "F0/{} = {:.3g} (pull-off force F0, largest diameter a); expected a higher pressure or a smaller "
              "equilibrium.stress",
              t.path_of(key), pressure, scene.dimension == 2 ? "a" : "a^2", least));
  };
  for_each_pressure(root, scene, check, changes_pull_off_force);
}

/// Records a fault if contacts are so stiff that rounding errors exceed tolerances: rounding of the sides of the cell
/// causes stresses, and rounding of positions causes net forces.
void check_stiffness(TableReader& root, const Scene& scene) {
  constexpr double kHalfUnit = 0.5 * std::numeric_limits<double>::epsilon();
  const double a = scene.grains.largest();
  // Area (length in 2D) by which a stress is multiplied to give a force on a grain.
  const double area = std::pow(a, scene.dimension - 1);
  const double F1 = std::max(pull_off_force(scene), scene.assembly.pressure * area);
  TableReader equilibrium = root.table("equilibrium", "", Need::optional);
  TableReader contact = root.table("contact", "", Need::optional);
  if (!contact || scene.law.is_rigid() || !(a > 0) || !(F1 > 0)) return;
  const double stiffness = area * scene.law.contact_modulus(scene.dimension, a);
  const bool varies = scene.law.force_exponent() != 1.0;
  const double kappa = varies ? std::pow(stiffness / F1, 2.0 / 3.0) : stiffness / F1;
  // Each side of the cell is stored as one double. The rounding error of a side changes all overlaps, and therefore the
  // stress (see solve_statics()).
  if (4 * kHalfUnit * kappa >= scene.relaxation.tolerance.stress)
    contact.fault(
        "normal",
        fmt::format(
            "contact.normal.{} = {}: the contacts are so stiff that rounding errors cause stresses of {:.1e} "
            "F1/a^(d-1), where F1 is the larger of the pull-off force and P a^(d-1) (first pressure P, largest "
            "diameter a, dimension d); expected errors below equilibrium.stress = {:.1e}, so give softer "
            "contacts or a larger equilibrium.stress",
            varies ? "modulus" : "stiffness", stiffness / a, 4 * kHalfUnit * kappa,
            scene.relaxation.tolerance.stress));
  // While the packing moves, each coordinate of a grain is stored as one double. The rounding errors of about four
  // contacts add up to a net force on the grain.
  const double side =
      std::pow(scene.grains.count / std::max(scene.assembly.solid_fraction, 0.1), 1.0 / scene.dimension);
  const double force = 4 * kHalfUnit * kappa * side;
  if (scene.relaxation.finish == Finish::dynamic && force >= scene.relaxation.tolerance.force)
    equilibrium.fault(
        "finish",
        fmt::format(
            "equilibrium.finish = \"dynamic\": rounding errors of the positions cause net forces of "
            "{:.1e} F1 on grains, where F1 is the larger of the pull-off force and P a^(d-1) (first "
            "pressure P, largest diameter a, dimension d), but "
            "equilibrium.force = {:.1e} requires smaller forces; expected a larger equilibrium.force, or "
            "finish = \"auto\", which stores each position as a sum of two numbers",
            force, scene.relaxation.tolerance.force));
}

/// Records a fault if spheres are so soft that they overlap too far at an imposed pressure. Their overlaps are
/// proportional to 1/kappa (stiffness number kappa), and Hertz' law holds only for small overlaps.
void check_overlaps(TableReader& root, const Scene& scene) {
  constexpr double kLeastKappa = 30.0;
  if (!scene.law.is_for_small_overlaps()) return;
  const auto check = [&](TableReader& t, const char* key, double pressure) {
    const double kappa = hertz_kappa(scene, pressure);
    if (pressure > 0 && kappa < kLeastKappa)
      t.fault(key,
              fmt::format("{} = {}: at this pressure P the stiffness number kappa = (E~/P)^(2/3), with E~ = "
                          "E/(1 - nu^2), is {:.3g}; expected at least {}, because softer spheres overlap too "
                          "far for contact.normal.law = \"{}\"",
                          t.path_of(key), pressure, kappa, kLeastKappa, scene.law.normal_keyword()));
  };
  for_each_pressure(root, scene, check, [](const LoadStage&) { return false; });
}

/// Records a fault if adhesion alone makes two grains overlap too far. Their overlap is F0/K_N, with the pull-off force
/// F0 and the normal stiffness K_N.
void check_cohesive_overlap(TableReader& root, const Scene& scene) {
  constexpr double kLargest = 0.1;
  if (!scene.assembly.box || !scene.law.has_adhesion() || scene.law.force_exponent() != 1.0) return;
  const double a = scene.grains.largest();
  const double stiffness = a * scene.law.contact_modulus(scene.dimension, a) * std::pow(a, scene.dimension - 2);
  const double overlap = scene.law.pull_off_force() / stiffness;
  TableReader contact = root.table("contact", "", Need::optional);
  if (contact && overlap > kLargest)
    contact.fault("adhesion",
                  fmt::format("contact.adhesion.force: the adhesion alone would make two grains overlap by "
                              "F0/(a K_N) = {:.3g} of their diameter; expected at most {}",
                              overlap, kLargest));
}

}  // namespace

void check_resolution(TableReader& root, const Scene& scene) {
  check_pressures(root, scene);
  check_overlaps(root, scene);
  check_cohesive_overlap(root, scene);
  check_stiffness(root, scene);
}

double stress_tolerance_limit(const Scene& scene) {
  double least = std::numeric_limits<double>::infinity();
  if (!has_least_pressure(scene)) return least;
  const auto add = [&](double pressure) {
    if (pressure > 0) least = std::min(least, pressure);
  };
  add(scene.assembly.pressure);
  for (const LoadStage& stage : scene.load) {
    if (changes_pull_off_force(stage)) break;
    for (const auto& [key, stress] : stresses_of(stage)) add(stress);
  }
  return least / unit_of_tolerance(scene);
}

}  // namespace floc
