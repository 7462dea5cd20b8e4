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

/// Returns the stresses at the end of a stage, each with the key that gives it.
std::vector<std::pair<const char*, double>> stresses_of(const LoadStage& stage) {
  if (stage.is_isotropic()) return {{stage.control == "axes" ? "axes" : "to", stage.to}};
  std::vector<std::pair<const char*, double>> stresses;
  for (const AxisLoad& axis : stage.axes)
    if (axis.kind == AxisLoad::stress) stresses.emplace_back(stage.control == "axes" ? "axes" : "to", axis.end);
  return stresses;
}

/// Calls check(table, key, pressure) for the first pressure and for those of each stage before the first one for
/// which `ends` is true.
template <class Check, class Ends>
void for_each_pressure(TableReader& root, const Scene& scene, const Check& check, const Ends& ends) {
  TableReader assembly = root.table("assembly", "", Need::optional);
  if (assembly) check(assembly, "pressure", scene.assembly.pressure);
  if (scene.load.empty()) return;
  std::vector<TableReader> stages = root.tables("load", "tables [[load]]");
  for (std::size_t k = 0; k < std::min(stages.size(), scene.load.size()) && !ends(scene.load[k]); ++k)
    for (const auto& [key, stress] : stresses_of(scene.load[k])) check(stages[k], key, stress);
}

/// Records a fault for a pressure below the possible error of a stress: it cannot be distinguished from zero.
void check_pressures(TableReader& root, const Scene& scene) {
  if (!scene.law.adheres() || scene.assembly.box || !(scene.grains.diameter.max > 0)) return;
  const double area = std::pow(scene.grains.diameter.max, scene.dimension - 1);  // a length in 2D
  const double least = scene.relaxation.tolerance.stress * pull_off_force(scene) / area;
  const auto check = [&](TableReader& t, const char* key, double pressure) {
    if (pressure > 0 && pressure <= least)
      t.fault(
          key,
          fmt::format(
              "{} = {}: expected more than equilibrium.stress * F0/{} = {:.3g}, the error that a stress may "
              "have, or a smaller equilibrium.stress",
              t.path_of(key), pressure, scene.dimension == 2 ? "a" : "a^2", least));
  };
  // A change of the adhesion changes the unit of the error of a stress, so that stage and later ones are not checked.
  for_each_pressure(root, scene, check, [](const LoadStage& stage) {
    return std::any_of(stage.set.begin(), stage.set.end(),
                       [](const auto& change) { return change.first == "adhesion.force"; });
  });
}

/// Records faults of contacts so stiff that the rounding of sides and positions leaves more than the tolerances.
void check_stiffness(TableReader& root, const Scene& scene) {
  constexpr double kHalfUnit = 0.5 * std::numeric_limits<double>::epsilon();
  const double a = scene.grains.diameter.max;
  const double area = std::pow(a, scene.dimension - 1);  // a length in 2D
  const double F1 = std::max(pull_off_force(scene), scene.assembly.pressure * area);
  TableReader equilibrium = root.table("equilibrium", "", Need::optional);
  TableReader contact = root.table("contact", "", Need::optional);
  if (!contact || !(a > 0) || !(F1 > 0)) return;
  const double stiffness = area * scene.law.contact_modulus(scene.dimension, a);
  const bool varies = scene.law.force_exponent() != 1.0;
  const double kappa = varies ? std::pow(stiffness / F1, 2.0 / 3.0) : stiffness / F1;
  // Each side of the cell is stored as one double: see solve_statics().
  if (4 * kHalfUnit * kappa >= scene.relaxation.tolerance.stress)
    contact.fault("normal",
                  fmt::format("contact.normal.{} = {}: rounding leaves a stress of {:.1e} F1/a, expected "
                              "less than equilibrium.stress = {:.1e}",
                              varies ? "modulus" : "stiffness", stiffness / a, 4 * kHalfUnit * kappa,
                              scene.relaxation.tolerance.stress));
  // In motion each coordinate is one double; about four contacts hold a grain.
  const double side =
      std::pow(scene.grains.count / std::max(scene.assembly.solid_fraction, 0.1), 1.0 / scene.dimension);
  const double force = 4 * kHalfUnit * kappa * side;
  if (scene.relaxation.finish == Finish::dynamic && force >= scene.relaxation.tolerance.force)
    equilibrium.fault(
        "finish", fmt::format("equilibrium.finish = \"dynamic\": rounding of positions leaves net forces of "
                              "{:.1e} F1, expected less than equilibrium.force = {:.1e}, or finish = "
                              "\"auto\", which keeps them in two parts",
                              force, scene.relaxation.tolerance.force));
}

/// Records a fault if kappa is too small: overlaps of spheres scale as 1/kappa, and Hertz' law does not hold for
/// large ones.
void check_overlaps(TableReader& root, const Scene& scene) {
  constexpr double kLeastKappa = 30.0;
  if (!scene.law.is_for_small_overlaps()) return;
  const auto check = [&](TableReader& t, const char* key, double pressure) {
    const double kappa = hertz_kappa(scene, pressure);
    if (pressure > 0 && kappa < kLeastKappa)
      t.fault(key, fmt::format("{} = {}: kappa = (E~/P)^(2/3) = {:.3g}, expected at least {}: spheres would "
                               "overlap too far for contact.normal.law = \"{}\"",
                               t.path_of(key), pressure, kappa, kLeastKappa, scene.law.normal_keyword()));
  };
  for_each_pressure(root, scene, check, [](const LoadStage&) { return false; });
}

/// Records a fault if a pair pulled together by its adhesion alone overlaps too much; its overlap is F0/K_N.
void check_cohesive_overlap(TableReader& root, const Scene& scene) {
  constexpr double kLargest = 0.1;
  if (!scene.assembly.box || !scene.law.has_adhesion() || scene.law.force_exponent() != 1.0) return;
  const double a = scene.grains.diameter.max;
  const double stiffness = a * scene.law.contact_modulus(scene.dimension, a) * std::pow(a, scene.dimension - 2);
  const double overlap = scene.law.pull_off_force() / stiffness;
  TableReader contact = root.table("contact", "", Need::optional);
  if (contact && overlap > kLargest)
    contact.fault("adhesion",
                  fmt::format("contact.adhesion.force: F0/(a K_N) = {:.3g}, the overlap of a free pair in "
                              "diameters; expected at most {}",
                              overlap, kLargest));
}

}  // namespace

void check_resolution(TableReader& root, const Scene& scene) {
  check_pressures(root, scene);
  check_overlaps(root, scene);
  check_cohesive_overlap(root, scene);
  check_stiffness(root, scene);
}

}  // namespace floc
