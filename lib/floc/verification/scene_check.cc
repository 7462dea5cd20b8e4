#include "floc/verification/scene_check.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "floc/loading/load_path.h"
#include "floc/loading/run_plan.h"
#include "floc/packing/grain_sizes.h"
#include "floc/packing/wall_forces.h"
#include "floc/scene/read_scene.h"
#include "floc/scene/scene_mass.h"

namespace floc {
namespace {

/// Compares the masses of the grains with the masses that follow from their sizes and the density of the scene. The
/// value of the criterion is the largest relative difference between the two.
template <int Dim>
Criterion check_mass(const std::string& file, const State<Dim>& state) {
  constexpr double kRelative = 1e-12;
  Criterion result{"mass", 0.0, kRelative, true, ""};
  const auto per_cube = mass_per_cubed_diameter(state.scene, Dim, file + ": scene");
  if (!per_cube) return result;
  const Grains<Dim>& g = state.packing.grains;
  for (int i = 0; i < g.size(); ++i) {
    double expected = *per_cube * std::pow(2.0 * g.radius[i], Dim);
    if (!g.are_round()) expected *= g.volume(i) / Ball<Dim>{g.radius[i]}.volume();
    const double error = std::abs(g.mass[i] - expected) / expected;
    if (error <= result.value) continue;
    result.value = error;
    result.where = fmt::format(
        "the mass {:.6g} of grain {}, whose radius is {:.6g}, differs from the mass {:.6g} that follows from "
        "the density of the scene",
        g.mass[i], g.name(i), g.radius[i], expected);
  }
  result.holds = result.value <= kRelative;
  if (result.holds) result.where.clear();
  return result;
}

/// Reads the scene (the description of the simulation) that is stored in a state. Returns std::nullopt if the state has
/// no scene, or if the scene cannot be read, for example because the saved state from which the scene starts is
/// missing.
/// @param file  name of the state file
/// @param text  text of the scene
/// @param why_not  set to the reason if the scene cannot be read
std::optional<Scene> scene_of(const std::string& file, const std::string& text, std::string& why_not) {
  if (text.empty()) return std::nullopt;
  std::string reason;
  std::optional<Scene> scene = scene_of_state(text, file, reason);
  if (!scene) why_not = fmt::format("the state was not compared with its scene: {}", reason);
  return scene;
}

/// Largest accepted tolerance of a state without a scene. Tolerances are in units of the force scale F1 and the largest
/// diameter of the packing. A packing whose net forces reach this tolerance is far from equilibrium.
constexpr double kLargestTolerance = 10.0;

/// Checks the tolerances of the equilibrium that are recorded in a state.
/// @param t  recorded tolerances
/// @param expected  tolerances of the scene; absent if the state has no scene
Criterion check_tolerances(const EquilibriumTolerance& t, const std::optional<EquilibriumTolerance>& expected) {
  struct Named {
    const char* name;
    double EquilibriumTolerance::*member;
  };
  constexpr Named kAll[] = {{"force", &EquilibriumTolerance::force},
                            {"moment", &EquilibriumTolerance::moment},
                            {"stress", &EquilibriumTolerance::stress},
                            {"energy", &EquilibriumTolerance::energy}};
  int n_wrong = 0;
  std::string where;
  for (const auto& [name, member] : kAll) {
    const double value = t.*member;
    if (expected ? value == *expected.*member : value > 0.0 && value <= kLargestTolerance) continue;
    ++n_wrong;
    where +=
        fmt::format("{}the tolerance of {} is recorded as {:g}, but {}", where.empty() ? "" : "; ", name, value,
                    expected ? fmt::format("the scene has {:g}", *expected.*member)
                             : fmt::format("a number in (0, {:g}] is expected", kLargestTolerance));
  }
  return {"tolerances", static_cast<double>(n_wrong), 0.0, n_wrong == 0, where};
}

/// Differences between a state and its scene, as text.
class Differences {
 public:
  template <class Value>
  void compare(const char* name, const Value& recorded, const Value& of_scene) {
    if (recorded != of_scene)
      add(fmt::format("{} is recorded as {}, but the scene has {}", name, recorded, of_scene));
  }
  /// Compares a recorded number with the number in the scene. Rounding errors are accepted, because another compiler
  /// may have computed the recorded number.
  void compare_number(const std::string& name, double recorded, double of_scene) {
    constexpr double kRelative = 1e-12;
    if (std::abs(recorded - of_scene) > kRelative * std::abs(of_scene))
      add(fmt::format("{} is recorded as {:.9g}, but the scene has {:.9g}", name, recorded, of_scene));
  }
  void add(const std::string& what) { words_ += (n_++ == 0 ? "" : "; ") + what; }
  Criterion criterion() const { return {"scene", static_cast<double>(n_), 0.0, n_ == 0, words_}; }

 private:
  std::string words_;
  int n_ = 0;
};

template <int Dim>
void compare_load(const State<Dim>& state, const PlannedEquilibrium& planned, Differences& found) {
  const StageReference& turn = state.path.turn;
  found.compare("path/control", turn.control, planned.is_isotropic() ? std::string() : planned.control);
  if (planned.is_isotropic() != turn.empty()) return;
  if (planned.is_isotropic()) {
    for (int a = 0; a < Dim; ++a)
      found.compare_number(fmt::format("equilibrium/target of axis {}", a + 1), state.target_stress[a],
                           planned.pressure);
    return;
  }
  found.compare("path/axis", turn.axis + 1, planned.axis + 1);
  found.compare_number("path/turn_shear", turn.shear, planned.shear);
  const auto load = load_target<Dim>(planned.axes, turn);
  for (int a = 0; a < Dim; ++a) {
    found.compare_number(fmt::format("equilibrium/target_side of axis {}", a + 1), state.target_side[a],
                         load.side[a]);
    if (!load.strained(a))
      found.compare_number(fmt::format("equilibrium/target of axis {}", a + 1), state.target_stress[a],
                           load.stress[a]);
  }
}

template <int Dim>
void compare_walls(const Packing<Dim>& packing, const PlannedEquilibrium& planned, const Scene& scene,
                   Differences& found) {
  const auto& box = scene.assembly.box;
  if (packing.walls.empty() == box.has_value())
    return found.add("either the scene or the state has walls, but not both");
  if (!box) return;
  if (packing.wall_law != wall_law(planned.law, *box))
    found.add("the contact law of the walls (wall_law) differs from the contact law of the walls in the scene");
  for (int a = 0; a < Dim; ++a)
    found.compare_number(fmt::format("equilibrium/gravity of axis {}", a + 1), packing.gravity[a],
                         box->gravity[a]);
  for (std::size_t w = 0; w < packing.walls.size(); ++w) {
    const Wall<Dim>& wall = packing.walls[w];
    const BoxSide side = box->boundary[wall.axis];
    const bool follows = side == BoxSide::walls || (side == BoxSide::lid && wall.side > 0);
    const bool open = side == BoxSide::floor && wall.side > 0;
    if (side == BoxSide::periodic || follows != follows_forces(wall) || open != wall.open)
      found.add(fmt::format(
          "wall {} contradicts the scene, which has another kind of boundary along the axis of this wall", w));
    else if (follows)
      found.compare_number(fmt::format("walls/mass of wall {}", w), wall.mass,
                           box->mass * largest_mass(packing.grains));
  }
}

template <int Dim>
Criterion check_scene(const State<Dim>& state, const Scene& scene) {
  Differences found;
  found.compare("units", state.units, scene.units);
  const auto plan = plan_run(scene.assembly, scene.law, scene.load, Dim);
  if (state.path.step < 0 || state.path.step >= static_cast<int>(plan.size())) {
    found.add(fmt::format("path/step is recorded as {}, but the scene has only the states 0 to {}",
                          state.path.step, plan.size() - 1));
    return found.criterion();
  }
  const PlannedEquilibrium& planned = plan[static_cast<std::size_t>(state.path.step)];
  found.compare("path/branch", state.path.branch, planned.branch);
  if (state.packing.law != planned.law)
    found.add("the contact law (law) differs from the contact law of the scene at this step");
  compare_load(state, planned, found);
  compare_walls(state.packing, planned, scene, found);
  return found.criterion();
}

}  // namespace

template <int Dim>
std::vector<Criterion> check_against_scene(const std::string& file, const State<Dim>& state) {
  std::string why_not;
  const std::optional<Scene> scene = scene_of(file, state.scene, why_not);
  std::optional<EquilibriumTolerance> tolerance;
  if (scene) tolerance = scene->relaxation.tolerance;
  return {check_mass(file, state), check_tolerances(state.tolerance, tolerance),
          scene ? check_scene(state, *scene) : Criterion{"scene", std::nullopt, 0.0, true, why_not}};
}

template <int Dim>
std::optional<double> scene_gap_tolerance(const std::string& file, const State<Dim>& state) {
  std::string why_not;
  const std::optional<Scene> scene = scene_of(file, state.scene, why_not);
  return scene ? scene->relaxation.contact_dynamics.gap_tolerance : std::nullopt;
}

template std::optional<double> scene_gap_tolerance(const std::string&, const State<2>&);
template std::optional<double> scene_gap_tolerance(const std::string&, const State<3>&);
template std::vector<Criterion> check_against_scene(const std::string&, const State<2>&);
template std::vector<Criterion> check_against_scene(const std::string&, const State<3>&);

}  // namespace floc
