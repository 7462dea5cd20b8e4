#include "floc/tradeoff/studied_setting.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "floc/base/error.h"
#include "floc/base/nearest_name.h"
#include "floc/scene/check_masses.h"
#include "floc/scene/scene_softening.h"

namespace floc {
namespace {

using Settings = std::vector<StudiedSetting>;

void add(const StudiedSetting& base, const std::string& parameter, const std::string& value,
         const std::function<void(StudiedSetting&)>& change, Settings& list) {
  StudiedSetting setting = base;
  setting.parameter = parameter;
  setting.value = value;
  change(setting);
  list.push_back(std::move(setting));
}

bool applies_to_elastic(const Scene& scene) {
  return !scene.has_contact_dynamics();
}

bool applies_to_rigid(const Scene& scene) {
  return scene.law.is_rigid();
}

bool applies_to_cells(const Scene& scene) {
  return !scene.assembly.box;
}

/// Whether equilibria of the scene can be completed by Newton's method. This is possible for elastic grains in periodic
/// cells. In packings between walls, grains always move until they reach equilibrium.
bool applies_to_newton(const Scene& scene) {
  return applies_to_elastic(scene) && applies_to_cells(scene);
}

bool applies_to_walls(const Scene& scene) {
  return scene.assembly.box.has_value();
}

/// Whether the grains have several masses and could move with equal ones.
bool applies_to_several_masses(const Scene& scene) {
  return allows_equal_masses(scene) && scene.grains.smallest() < scene.grains.largest();
}

bool applies_to_decades(const Scene& scene) {
  return std::any_of(scene.load.begin(), scene.load.end(),
                     [](const LoadStage& stage) { return stage.steps_per_decade.has_value(); });
}

void add_moduli(const Scene&, const StudiedSetting& base, Settings& list) {
  const auto method = [&](const char* value, ModuliMethod chosen, double tolerance) {
    add(
        base, "moduli", value,
        [&](StudiedSetting& s) {
          s.moduli.method = chosen;
          s.moduli.tolerance = tolerance;
        },
        list);
  };
  method("bounds", ModuliMethod::bounds, 1.0);
  method("iterative 1e-2", ModuliMethod::iterative, 1e-2);
  method("iterative 1e-6", ModuliMethod::iterative, 1e-6);
  method("single-factor 1e-6", ModuliMethod::single_factor, 1e-6);
  method("factor 1e-10", ModuliMethod::factor, 1e-10);
}

void add_together(const Scene&, const StudiedSetting& base, Settings& list) {
  const auto all = [&](const char* value, const NumericalSettings& n) {
    add(
        base, "together", value,
        [&](StudiedSetting& s) {
          s.numerical = n;
          s.numerical.softening = base.numerical.softening;
          s.numerical.equal_masses = base.numerical.equal_masses;
        },
        list);
  };
  all("coarse", {1e-2, 0.36, Finish::statics, 0.2});
  all("medium", {1e-4, 0.36, Finish::statics, 0.2});
  all("fine", {1e-5, 0.36, Finish::statics, 0.2});
  all("careful", {1e-4, 0.14, Finish::automatic, 1.0});
}

void add_rigid_together(const Scene&, const StudiedSetting& base, Settings& list) {
  for (const RigidSettingsTogether& together : kRigidTogether)
    add(
        base, "together", together.value,
        [&](StudiedSetting& s) {
          s.contact_dynamics.time_step = together.time_step;
          s.contact_dynamics.sweep_tolerance = together.sweep_tolerance;
        },
        list);
}

void add_finish(const Scene&, const StudiedSetting& base, Settings& list) {
  add(
      base, "finish", "dynamic", [](StudiedSetting& s) { s.numerical.finish = Finish::dynamic; }, list);
  add(
      base, "finish", "static", [](StudiedSetting& s) { s.numerical.finish = Finish::statics; }, list);
}

std::string name_of(RigidForces forces) {
  return kRigidForcesKeywords[static_cast<std::size_t>(forces)];
}

std::string name_of(LatticeMethod method) {
  return method == LatticeMethod::factor      ? "factor"
         : method == LatticeMethod::iterative ? "iterative"
                                              : "automatic";
}

void add_forces(const Scene& scene, const StudiedSetting& base, Settings& list) {
  for (const RigidForces forces : {RigidForces::closest, RigidForces::canonical})
    if (forces != scene.relaxation.contact_dynamics.forces)
      add(
          base, "finish", name_of(forces), [&](StudiedSetting& s) { s.contact_dynamics.forces = forces; },
          list);
}

/// Adds settings with other tolerances. They all have finish = "dynamic", so that equilibrium is reached by motion
/// alone. With Newton's method, the residual would be about 1e-8 for every tolerance.
void add_tolerance(const Scene&, const StudiedSetting& base, Settings& list) {
  for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-6, 1e-8})
    add(
        base, "tolerance", fmt::format("{:.0e} dynamic", tolerance),
        [&](StudiedSetting& s) {
          s.numerical.tolerance = tolerance;
          s.numerical.finish = Finish::dynamic;
        },
        list);
}

void add_time_step(const Scene&, const StudiedSetting& base, Settings& list) {
  for (const double step : {0.28, 0.2, 0.1})
    add(
        base, "time_step", fmt::format("{}", step), [&](StudiedSetting& s) { s.numerical.time_step = step; },
        list);
}

void add_rigid_time_step(const Scene&, const StudiedSetting& base, Settings& list) {
  for (const double step : {0.2, 0.1, 0.025})
    add(
        base, "time_step", fmt::format("{}", step),
        [&](StudiedSetting& s) { s.contact_dynamics.time_step = step; }, list);
}

void add_sweep_tolerance(const Scene&, const StudiedSetting& base, Settings& list) {
  for (const double tolerance : {1e-1, 1e-2, 1e-4})
    add(
        base, "sweep_tolerance", fmt::format("{:.0e}", tolerance),
        [&](StudiedSetting& s) { s.contact_dynamics.sweep_tolerance = tolerance; }, list);
}

void add_gap_tolerance(const Scene&, const StudiedSetting& base, Settings& list) {
  for (const double tolerance : {1e-2, 1e-3, 1e-4})
    add(
        base, "gap_tolerance", fmt::format("{:.0e}", tolerance),
        [&](StudiedSetting& s) { s.contact_dynamics.gap_tolerance = tolerance; }, list);
}

/// Adds settings with softer contact springs in the whole run, up to the largest softening that the scene allows.
void add_softening(const Scene& scene, const StudiedSetting& base, Settings& list) {
  const Softening largest = largest_softening(scene);
  for (const double factor : {3.0, 10.0, 30.0})
    if (factor <= largest.assembly && factor <= largest.load)
      add(
          base, "softening", fmt::format("{}", factor),
          [&](StudiedSetting& s) {
            s.numerical.softening = {factor, factor};
          },
          list);
}

/// Adds settings with softer contact springs during the assembly only. On the load path, the springs have the stiffness
/// of the contact law.
void add_assembly_softening(const Scene& scene, const StudiedSetting& base, Settings& list) {
  if (scene.load.empty() || scene.starts_from_state()) return;
  for (const double factor : {10.0, 100.0})
    if (factor <= largest_softening(scene).assembly)
      add(
          base, "assembly_softening", fmt::format("{}", factor),
          [&](StudiedSetting& s) {
            s.numerical.softening = {factor, 1.0};
          },
          list);
}

void add_masses(const Scene&, const StudiedSetting& base, Settings& list) {
  add(
      base, "masses", masses_name(true), [](StudiedSetting& s) { s.numerical.equal_masses = true; }, list);
}

void add_patience(const Scene&, const StudiedSetting& base, Settings& list) {
  for (const double patience : {0.2, 0.5, 2.0})
    add(
        base, "patience", fmt::format("{}", patience),
        [&](StudiedSetting& s) { s.numerical.patience = patience; }, list);
}

void add_rate_cap(const Scene&, const StudiedSetting& base, Settings& list) {
  for (const double factor : {5.0, 0.2})
    add(
        base, "strain_rate_cap", fmt::format("{} times", factor),
        [&](StudiedSetting& s) { s.rate_cap_factor = factor; }, list);
}

void add_cell_mass(const Scene&, const StudiedSetting& base, Settings& list) {
  for (const double factor : {10.0, 0.1})
    add(
        base, "cell_mass", fmt::format("{} times", factor),
        [&](StudiedSetting& s) { s.cell_mass_factor = factor; }, list);
}

/// Adds settings for scenes with walls: other criteria that end a compaction and, if the scene limits the duration of
/// the compaction, other time limits.
void add_end(const Scene& scene, const StudiedSetting& base, Settings& list) {
  using Criterion = CompactionEnd::Criterion;
  if (scene.relaxation.compaction.criterion != Criterion::settled)
    add(
        base, "end", "settled", [](StudiedSetting& s) { s.compaction.criterion = Criterion::settled; }, list);
  for (const double ratio : {1e-3, 1e-5, 2e-7})
    add(
        base, "end", fmt::format("energy_ratio {:.0e}", ratio),
        [&](StudiedSetting& s) {
          s.compaction.criterion = Criterion::energy_ratio;
          s.compaction.energy_ratio = ratio;
        },
        list);
  if (!scene.relaxation.compaction.longest) return;
  for (const double factor : {0.5, 2.0})
    add(
        base, "stop_time", fmt::format("{} times", factor),
        [&](StudiedSetting& s) { *s.compaction.longest *= factor; }, list);
}

void add_count(const Scene& scene, const StudiedSetting& base, Settings& list) {
  for (const int share : {4, 2})
    if (const int n = scene.grains.count / share; n >= 20)
      add(
          base, "count", fmt::format("{}", n), [&](StudiedSetting& s) { s.n_grains = n; }, list);
}

void add_steps(const Scene&, const StudiedSetting& base, Settings& list) {
  for (const double factor : {0.5, 2.0})
    add(
        base, "steps_per_decade", fmt::format("{} times", factor),
        [&](StudiedSetting& s) { s.steps_factor = factor; }, list);
}

StudiedSetting as_it_is(const Scene& scene) {
  StudiedSetting setting;
  setting.parameter = "scene";
  setting.value = "as it is";
  setting.numerical = settings_of(scene);
  setting.contact_dynamics = scene.relaxation.contact_dynamics;
  setting.compaction = scene.relaxation.compaction;
  return setting;
}

StudiedSetting strictest(const Scene& scene) {
  /// Sweep tolerance and time step of the strictest settings of rigid grains.
  constexpr double kSweeps = 1e-6, kTimeStep = 0.0125;
  StudiedSetting setting = as_it_is(scene);
  setting.parameter = "strict";
  setting.value = "all";
  if (scene.law.is_rigid()) {
    setting.contact_dynamics.time_step = std::min(kTimeStep, setting.contact_dynamics.time_step);
    setting.contact_dynamics.sweep_tolerance = std::min(kSweeps, setting.contact_dynamics.sweep_tolerance);
    setting.contact_dynamics.gap_tolerance = 1e-5;
  } else {
    setting.numerical = strict_settings();
  }
  return setting;
}

/// Multiplies the caps on the strain rate of the cell by `factor`.
/// @param capped  a CellResponse or RelaxationOptions, which contains the caps
template <class Capped>
void scale_caps(double factor, Capped& capped) {
  if (capped.strain_rate_cap) *capped.strain_rate_cap *= factor;
  if (capped.inertial_number_cap) *capped.inertial_number_cap *= factor;
}

}  // namespace

bool has_any_number_of_grains(const Scene& scene) {
  return !scene.starts_from_state() && scene.grains.diameter.kind != DiameterDistribution::Kind::list;
}

void keep_parameters(const std::vector<std::string>& names, std::vector<StudiedSetting>& settings) {
  if (names.empty()) return;
  std::vector<std::string> known;
  for (const StudiedSetting& s : settings)
    if (!s.is_compared_with() && (known.empty() || known.back() != s.parameter)) known.push_back(s.parameter);
  for (const std::string& name : names)
    if (std::ranges::find(known, name) == known.end())
      throw InputError("--knobs " + name,
                       fmt::format("a study of this scene does not vary this parameter: expected some of "
                                   "{}; the nearest is {}",
                                   fmt::join(known, ", "), nearest_name(name, known)));
  std::erase_if(settings, [&](const StudiedSetting& s) {
    return !s.is_compared_with() && std::ranges::find(names, s.parameter) == names.end();
  });
}

const std::vector<DeclaredSetting>& declared_settings() {
  static const std::vector<DeclaredSetting> settings = {
      {"moduli", applies_to_elastic, add_moduli},
      {"together", applies_to_elastic, add_together},
      {"together", applies_to_rigid, add_rigid_together},
      {"finish", applies_to_newton, add_finish},
      {"finish", applies_to_rigid, add_forces},
      {"tolerance", applies_to_elastic, add_tolerance},
      {"time_step", applies_to_elastic, add_time_step},
      {"time_step", applies_to_rigid, add_rigid_time_step},
      {"sweep_tolerance", applies_to_rigid, add_sweep_tolerance},
      {"gap_tolerance", applies_to_rigid, add_gap_tolerance},
      {"end", applies_to_walls, add_end},
      {"patience", applies_to_elastic, add_patience},
      {"softening", applies_to_newton, add_softening},
      {"assembly_softening", applies_to_newton, add_assembly_softening},
      {"masses", applies_to_several_masses, add_masses},
      {"strain_rate_cap", applies_to_cells, add_rate_cap},
      {"cell_mass", applies_to_cells, add_cell_mass},
      {"count", has_any_number_of_grains, add_count},
      {"steps_per_decade", applies_to_decades, add_steps},
  };
  return settings;
}

NumericalSettings strict_settings() {
  return {1e-8, 0.07, Finish::automatic, 2.0};
}

std::vector<StudiedSetting> studied_settings(const Scene& scene) {
  const StudiedSetting base = as_it_is(scene);
  Settings list = {strictest(scene), base};
  for (const DeclaredSetting& declared : declared_settings())
    if (declared.applies(scene)) declared.add(scene, base, list);
  return list;
}

std::vector<StudiedSetting> lattice_settings(const Scene& scene) {
  const bool flat = scene.dimension == 2;
  // A scene contains no settings of the lattice. The study therefore uses the defaults of `floc lattice` for the scene
  // as it is.
  const double nodes = flat ? 15.0 : 6.5, tolerance = flat ? 1e-10 : 1e-9;
  StudiedSetting base = as_it_is(scene);
  base.lattice = LatticeSettings{nodes, LatticeMethod::automatic, tolerance};
  Settings list;
  // The first variant is the reference to which all others are compared. Its lattice is finer and its tolerance is
  // smaller than those of all other variants, so that it has the smallest error.
  add(
      base, "strict", "all",
      [&](StudiedSetting& s) {
        s.lattice = {flat ? 35.0 : 12.0, LatticeMethod::automatic, 1e-3 * tolerance};
      },
      list);
  list.push_back(base);
  for (const double n : flat ? std::vector{5.0, 8.0, 11.0, 22.0} : std::vector{3.0, 4.5, 9.0})
    add(
        base, "nodes_a_diameter", fmt::format("{}", n),
        [&](StudiedSetting& s) { s.lattice->nodes_a_diameter = n; }, list);
  for (const double t : {1e-2, 1e-4, 1e-6, 1e-8})
    add(
        base, "tolerance", fmt::format("{:.0e}", t), [&](StudiedSetting& s) { s.lattice->tolerance = t; },
        list);
  for (const LatticeMethod method : {LatticeMethod::factor, LatticeMethod::iterative})
    add(
        base, "method", name_of(method), [&](StudiedSetting& s) { s.lattice->method = method; }, list);
  // The number of grains is fixed if the scene starts from a state or lists the diameters of its grains.
  if (has_any_number_of_grains(scene)) add_count(scene, base, list);
  return list;
}

double tolerance_of(const StudiedSetting& setting) {
  return setting.lattice ? setting.lattice->tolerance : setting.numerical.tolerance;
}

double time_step_of(const Scene& scene, const StudiedSetting& setting) {
  if (setting.lattice) return std::numeric_limits<double>::quiet_NaN();
  return scene.law.is_rigid() ? setting.contact_dynamics.time_step : setting.numerical.time_step;
}

double patience_of(const StudiedSetting& setting) {
  return setting.lattice ? std::numeric_limits<double>::quiet_NaN() : setting.numerical.patience;
}

std::string finish_of(const Scene& scene, const StudiedSetting& setting) {
  if (setting.lattice) return name_of(setting.lattice->method);
  return scene.law.is_rigid() ? name_of(setting.contact_dynamics.forces)
                              : finish_name(setting.numerical.finish);
}

RunOptions run_options(const Scene& scene, const StudiedSetting& setting, std::uint64_t seed) {
  RunOptions options = scene;
  options.seed = seed;
  options.text.clear();
  apply_settings(setting.numerical, options);
  // A scene gives four tolerances, but a study varies only the tolerance of the forces. If a setting has the force
  // tolerance of the scene, all four tolerances of the scene are used.
  if (setting.numerical.tolerance == scene.relaxation.tolerance.force)
    options.relaxation.tolerance = scene.relaxation.tolerance;
  options.relaxation.contact_dynamics = setting.contact_dynamics;
  options.relaxation.compaction = setting.compaction;
  options.relaxation.threads = 1;
  if (setting.n_grains > 0) options.grains.count = setting.n_grains;
  // Where parts of the run have their own time steps, these become shorter together with that of the run.
  const double shorter = std::min(1.0, options.relaxation.time_step / scene.relaxation.time_step);
  if (options.assembly.cell.time_step) *options.assembly.cell.time_step *= shorter;
  for (LoadStage& stage : options.load) {
    stage.cell.cell_mass = setting.cell_mass_factor * stage.cell.applied_to(options.relaxation).cell_mass;
    scale_caps(setting.rate_cap_factor, stage.cell);
    if (stage.cell.time_step) *stage.cell.time_step *= shorter;
    if (stage.steps_per_decade) *stage.steps_per_decade *= setting.steps_factor;
  }
  scale_caps(setting.rate_cap_factor, options.assembly.cell);
  scale_caps(setting.rate_cap_factor, options.relaxation);
  return options;
}

}  // namespace floc
