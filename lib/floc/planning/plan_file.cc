#include "floc/planning/plan_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/base/string_literal.h"
#include "floc/scene/read_scene.h"
#include "floc/scene/scene_changes.h"
#include "floc/scene/scene_softening.h"

namespace floc {
namespace {

namespace fs = std::filesystem;

/// Returns the value of an override in TOML notation: a word without quotation marks becomes a string.
std::string as_toml(const std::string& value) {
  const bool is_quoted = !value.empty() && std::string("\"'[{").find(value.front()) != std::string::npos;
  if (is_quoted || value == "true" || value == "false" || parse_number<double>(value)) return value;
  return string_literal(value);
}

/// Checks that no change sets a table of which another change sets a key: TOML does not allow both in one table.
void require_separate_keys(const std::vector<std::string>& changes) {
  for (const std::string& whole : changes)
    for (const std::string& part : changes)
      if (const std::string key = whole.substr(0, whole.find('=')); part.starts_with(key + "."))
        throw InputError(
            "--set " + whole,
            fmt::format("the plan sets the key {} of this table: expected --set with each key of the "
                        "table by itself, such as --set {}=VALUE",
                        part.substr(0, part.find('=')), part.substr(0, part.find('='))));
}

std::string as_setting(const std::string& change) {
  const std::size_t equals = change.find('=');
  return change.substr(0, equals) + " = " + as_toml(change.substr(equals + 1));
}

std::string quoted_list(const std::vector<std::string>& names) {
  return fmt::format("[\"{}\"]", fmt::join(names, "\", \""));
}

/// Returns those of `columns` that are promised observables.
std::vector<std::string> promised(const std::vector<std::string>& columns,
                                  const std::vector<ObservablePrice>& observables) {
  std::vector<std::string> out;
  for (const std::string& column : columns)
    if (std::ranges::count(observables, column, &ObservablePrice::name) > 0) out.push_back(column);
  return out;
}

/// Returns the tables [[collect]] and [[fit]] of a campaign file. They contain those observables that a table of floc
/// gives under the same name with the same meaning; floc plan --check computes the others from the states.
std::string collections_of(const std::vector<ObservablePrice>& observables) {
  std::vector<std::string> of_path = promised({"phi", "z_plus", "z_minus"}, observables);
  if (of_path.empty()) of_path = {"phi"};
  std::string text = fmt::format("\n[[collect]]\ntable = \"path\"\ncolumns = {}\n", quoted_list(of_path));
  if (const auto moduli = promised({"B", "G", "B_reuss"}, observables); !moduli.empty())
    text += fmt::format("\n[[collect]]\ntable = \"moduli\"\ncolumns = {}\n", quoted_list(moduli));
  if (std::ranges::any_of(observables, [](const auto& o) { return is_fitted(o.name); }))
    text += "\n[[fit]]\nlaw = \"consolidation\"\noptions = [\"--law\", \"full\"]\n";
  return text;
}

std::string promise_of(const Plan& plan, const std::vector<ObservablePrice>& observables,
                       const std::string& prices) {
  std::vector<std::string> errors;
  for (std::size_t k = 0; k < observables.size(); ++k)
    if (std::isfinite(plan.errors[k].total()))
      errors.push_back(fmt::format("{} = {:.4g}", observables[k].name, plan.errors[k].total()));
  return fmt::format(
      "\n[plan]                          # promises, with which floc plan --check DIR compares the "
      "runs\nsettings = "
      "{}\n"
      "prices = {}\ncore_seconds = {:.6g}\n# half widths of 95 % intervals, divided by the values\nerrors = "
      "{{{}}}\n",
      string_literal(plan.settings.name()), string_literal(prices), plan.core_seconds, fmt::join(errors, ", "));
}

/// Adds to `changes` the changes that give all parts of a run the time step `time_step`: the tables of prices hold runs
/// with one time step.
void add_time_step(double time_step, const Scene& scene, std::vector<std::string>& changes) {
  changes.push_back(fmt::format("run.time_step={:g}", time_step));
  if (scene.assembly.cell.time_step) changes.push_back(fmt::format("assembly.time_step={:g}", time_step));
  for (std::size_t k = 0; k < scene.load.size(); ++k)
    if (scene.load[k].cell.time_step) changes.push_back(fmt::format("load.{}.time_step={:g}", k, time_step));
}

/// Adds to `changes` the changes that give a scene the softening `softening`, unless the scene already has this
/// softening.
void add_softening(const Softening& softening, const Scene& scene, std::vector<std::string>& changes) {
  if (softening == softening_of(scene)) return;
  changes.push_back(fmt::format("equilibrium.softening={:g}", softening.load));
  changes.push_back(fmt::format("assembly.softening={:g}", softening.assembly));
  const std::vector<bool> strained = strained_stages(scene);
  for (std::size_t k = 0; k < scene.load.size(); ++k)
    if (strained[k] || scene.load[k].cell.softening)
      changes.push_back(fmt::format("load.{}.softening={:g}", k, strained[k] ? 1.0 : softening.load));
}

/// Returns the changes that give a scene of rigid grains the settings `chosen`. Costs and errors of a table hold for its
/// time step and sweep tolerance, so that other values in the scene are replaced.
std::vector<std::string> changes_of_rigid_grains(const PricedSettings& chosen, const Scene& scene) {
  std::vector<std::string> changes;
  if (chosen.parameter == "gap_tolerance" || chosen.parameter == "finish")
    changes.push_back(fmt::format("dynamics.{}={}", chosen.parameter, chosen.value));
  else if (chosen.parameter != "scene" && chosen.parameter != "time_step" &&
           chosen.parameter != "sweep_tolerance")
    throw InputError(
        chosen.name(),
        "these settings of rigid grains change several parameters and cannot be written into a scene");
  const bool is_of_pilot = chosen.of.empty();
  if (is_of_pilot) return changes;
  const ContactDynamicsOptions& own = scene.relaxation.contact_dynamics;
  if (own.time_step != chosen.settings.time_step)
    changes.push_back(fmt::format("dynamics.time_step={:g}", chosen.settings.time_step));
  const double sweeps = chosen.sweep_tolerance.value_or(ContactDynamicsOptions{}.sweep_tolerance);
  if (own.sweep_tolerance != sweeps) changes.push_back(fmt::format("dynamics.sweep_tolerance={:g}", sweeps));
  return changes;
}

Scene with_settings(const PlanSource& source, const Scene& scene, const PricedSettings& settings) {
  return parse_scene(scene.text, source.scene_file, fs::path(source.scene_file).parent_path().string(),
                     changes_of(settings, scene));
}

}  // namespace

bool is_fitted(const std::string& observable) {
  return observable == "lambda" || observable == "alpha" || observable == "Phi_max";
}

std::vector<std::string> changes_of(const PricedSettings& chosen, const Scene& scene) {
  std::vector<std::string> changes;
  const bool is_of_scene = chosen.parameter == "scene";
  if (scene.law.is_rigid()) return changes_of_rigid_grains(chosen, scene);
  const NumericalSettings& s = chosen.settings;
  if (is_of_scene && s == settings_of(scene)) return changes;
  for (const char* key : {"force", "moment", "stress"})
    changes.push_back(fmt::format("equilibrium.{}={:g}", key, s.tolerance));
  changes.push_back(fmt::format("equilibrium.energy={:g}", s.energy()));
  changes.push_back(fmt::format("equilibrium.patience={:g}", s.patience));
  if (!scene.assembly.box) changes.push_back(fmt::format("equilibrium.finish={}", finish_name(s.finish)));
  add_time_step(s.time_step, scene, changes);
  if (s.equal_masses != scene.relaxation.equal_masses)
    changes.push_back(fmt::format("equilibrium.masses={}", masses_name(s.equal_masses)));
  add_softening(s.softening, scene, changes);
  return changes;
}

bool allows(const PlanSource& source, const Scene& scene, const PricedSettings& settings) {
  try {
    (void)with_settings(source, scene, settings);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

std::vector<std::string> replaced_settings(const PlanSource& source, const Scene& scene,
                                           const PricedSettings& settings) {
  constexpr const char* kHere = "in the scene";
  std::vector<std::string> changes =
      scene_changes(scene.text, kHere, with_settings(source, scene, settings).text, "in the plan");
  std::erase_if(changes, [&](const std::string& change) {
    return change.find(fmt::format(" absent {},", kHere)) != std::string::npos;
  });
  return changes;
}

std::string plan_file(const Plan& plan, const std::vector<ObservablePrice>& observables, const Scene& scene,
                      const PlanSource& source, const std::string& output) {
  std::vector<std::string> changes = source.overrides;
  // If the plan and the user both change a key, the change by the plan replaces the change by the user, because a TOML
  // table contains each key only once.
  const auto set = [&](const std::string& change) {
    const std::string key = change.substr(0, change.find('=') + 1);
    std::erase_if(changes, [&](const std::string& c) { return c.starts_with(key); });
    changes.push_back(change);
  };
  for (const std::string& change : source.overrides) set(change);
  if (plan.n_grains != scene.grains.count) set(fmt::format("grains.count={}", plan.n_grains));
  for (const std::string& change : changes_of(plan.settings, scene)) set(change);
  require_separate_keys(changes);
  if (plan.n_samples == 1)
    return fmt::format(
        "# One sample, chosen by floc plan for {}. To make it: floc run {} -o DIR. Promised: {:.4g} s of "
        "processor "
        "time.\n"
        "{}",
        source.scene_file, output, plan.core_seconds, read_scene(source.scene_file, changes).text);
  std::vector<std::string> settings;
  for (const std::string& change : changes) settings.push_back(as_setting(change));
  const fs::path folder = fs::absolute(output).parent_path();
  std::string text = fmt::format(
      "# A plan for {0}, made by floc plan: {1} samples of {2} grains. The commands\n#\n"
      "#   floc campaign plan {3} -o {4}\n#   cd {4} && snakemake --cores {8}\n#   floc plan --check {4}\n#\n"
      "# make the runs and tables of the plan, and compare them with its promises.\n\n[campaign]\nscene = "
      "{5}\nseeds = "
      "\"{6}..{7}\"\n",
      scene.name, plan.n_samples, plan.n_grains, output, fs::path(output).stem().string(),
      string_literal(fs::absolute(source.scene_file).lexically_proximate(folder).generic_string()), scene.seed,
      scene.seed + static_cast<std::uint64_t>(plan.n_samples) - 1, source.cores);
  text += fmt::format("\n[[case]]\nname = \"plan\"\nset = {{{}}}\n", fmt::join(settings, ", "));
  return text + collections_of(observables) + promise_of(plan, observables, source.prices);
}

}  // namespace floc
