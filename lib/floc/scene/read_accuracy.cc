#include "floc/scene/read_accuracy.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "floc/scene/accuracy.h"
#include "floc/scene/cell_defaults.h"
#include "floc/scene/scene_scales.h"

namespace floc {
namespace {

constexpr NumberRule kRelativeError{positive, "a positive number (relative error)"};

/// Returns the stiffness number a K_N/F0 of a scene (largest diameter a, normal stiffness K_N, pull-off force F0), or
/// std::nullopt without adhesion.
std::optional<double> stiffness_number(const Scene& scene) {
  if (!scene.law.adheres()) return std::nullopt;
  const double a = scene.grains.largest();
  return a * scene.law.contact_modulus(scene.dimension, a) / pull_off_force(scene);
}

/// Returns the options of the relaxation, with the mass and the caps of the cell, in each part of a run: first in the
/// assembly, then in each stage of the load path.
std::vector<RelaxationOptions> motions_of_cell(const Scene& scene) {
  std::vector<RelaxationOptions> parts = {scene.assembly.cell.applied_to(scene.relaxation)};
  for (const LoadStage& stage : scene.load) parts.push_back(stage.cell.applied_to(scene.relaxation));
  return parts;
}

std::vector<CellFactors> cells_of(const Scene& scene) {
  std::vector<CellFactors> cells;
  for (const RelaxationOptions& part : motions_of_cell(scene))
    cells.push_back(
        {part.cell_mass / kLoadCellMass, part.strain_rate_cap.value_or(kStrainRateCap) / kStrainRateCap});
  // The mass of the cell during the assembly determines which packing is made. It does not affect the accuracy, so it
  // counts as the default.
  cells.front().mass = 1.0;
  return cells;
}

/// Records a fault if the mass of the cell, or the cap on its strain rate, is outside the range of the table of
/// measured errors shipped with floc. The range extends from the default values to those with which errors were
/// measured.
void check_table_covers_cell(TableReader& t, const Scene& scene) {
  for (const RelaxationOptions& part : motions_of_cell(scene))
    if (part.inertial_number_cap) {
      t.fault("",
              "[accuracy] requires strain_rate_cap in place of inertial_number_cap, because the errors in the "
              "table shipped with floc were measured with a strain_rate_cap");
      return;
    }
  for (const CellFactors& cell : cells_of(scene))
    if (!covers_cell(shipped_accuracy_table(), cell)) {
      t.fault("", fmt::format("[accuracy]: the mass of the cell is {:.3g} times the default mass on load "
                              "paths, and its strain_rate_cap is {:.3g} times the default; this is outside the "
                              "range of the table of errors shipped with floc. Remove [accuracy] and give the "
                              "numerical settings themselves ([equilibrium], run.time_step)",
                              cell.mass, cell.rate_cap));
      return;
    }
}

/// Records a fault for each key that gives a numerical setting which [accuracy] chooses: a scene may have either
/// [accuracy] or these keys.
void refuse_settings(TableReader& root) {
  TableReader equilibrium = root.table("equilibrium", "", TableReader::Need::optional);
  TableReader run = root.table("run", "", TableReader::Need::optional);
  const auto refuse = [](TableReader& t, const char* key) {
    t.refuse(key,
             fmt::format("{} is chosen by [accuracy]: expected either this key or [accuracy]", t.path_of(key)));
  };
  for (const char* key : {"force", "moment", "stress", "energy", "patience"}) refuse(equilibrium, key);
  const auto finish = equilibrium.text("finish", "a string", TableReader::Need::optional);
  if (finish && *finish != "auto") refuse(equilibrium, "finish");
  refuse(run, "time_step");
}

void check_table_covers(TableReader& t, const Scene& scene) {
  const std::optional<double> kappa = stiffness_number(scene);
  if (scene.dimension != 2)
    t.fault("",
            "[accuracy] requires a scene in two dimensions, like those on which the errors in the table "
            "shipped with floc were measured. Remove [accuracy] and give the numerical settings themselves "
            "([equilibrium], run.time_step)");
  else if (scene.assembly.box)
    t.fault("",
            "[accuracy] requires a scene with a periodic [cell], like those on which the errors in the table "
            "shipped with floc were measured");
  else if (!kappa)
    t.fault("",
            "[accuracy] requires a scene with contact.adhesion, because the errors in the table shipped with "
            "floc were measured on cohesive grains");
  else if (!covers_stiffness(shipped_accuracy_table(), *kappa))
    t.fault("",
            fmt::format(
                "[accuracy]: the stiffness number a K_N/F0 = {:g} is outside the range of the table of errors "
                "shipped with floc, which was measured at {:g} and applies within a factor of ten. Remove "
                "[accuracy] and give the numerical settings themselves ([equilibrium], run.time_step)",
                *kappa, shipped_accuracy_table().empty() ? 0.0 : shipped_accuracy_table()[0].kappa));
  else
    check_table_covers_cell(t, scene);
}

/// Writes the chosen numerical settings into the TOML tables of the scene. Its text then gives the settings of the run,
/// and they stay the same if a later version of floc has another table of measured errors.
void write_choice(const AccuracyChoice& choice, toml::table& root) {
  const auto table = [&](const char* name) -> toml::table& {
    return *root.insert(name, toml::table{}).first->second.as_table();
  };
  const NumericalSettings& s = choice.settings;
  table("accuracy").insert_or_assign("chosen", fmt::format("{}: {}", choice.name, choice.reason));
  toml::table& equilibrium = table("equilibrium");
  for (const char* key : {"force", "moment", "stress"}) equilibrium.insert_or_assign(key, s.tolerance);
  equilibrium.insert_or_assign("energy", s.energy());
  equilibrium.insert_or_assign("patience", s.patience);
  equilibrium.insert_or_assign("finish", finish_name(s.finish));
  table("run").insert_or_assign("time_step", s.time_step);
}

}  // namespace

bool read_accuracy(TableReader& root, SceneSource& source, Scene& scene) {
  TableReader t = root.table("accuracy", "a table [accuracy]", TableReader::Need::optional);
  // For rigid contacts, check_rigid() refuses the table.
  if (!t || scene.law.is_rigid()) return false;
  WantedAccuracy wanted;
  for (const std::string& key : accuracy_keys())
    if (const auto error = t.number(key, kRelativeError, TableReader::Need::optional))
      wanted.emplace_back(key, *error);
  const auto chosen = t.text("chosen", "a text that floc writes", TableReader::Need::optional);
  t.refuse_other_keys();
  if (chosen) {
    scene.accuracy = *chosen;
    return false;
  }
  refuse_settings(root);
  check_table_covers(t, scene);
  // If `wanted` is empty although the table has keys, their values are invalid, and faults have been recorded for them.
  const bool asks = std::ranges::any_of(accuracy_keys(), [&t](const std::string& key) { return t.has(key); });
  if (wanted.empty() && asks) return false;
  if (wanted.empty()) {
    t.fault("", fmt::format("[accuracy] requests no error: expected at least one of the keys {}",
                            fmt::join(accuracy_keys(), ", ")));
    return false;
  }
  const AccuracyChoice choice = choose_accuracy(shipped_accuracy_table(), wanted, cells_of(scene));
  if (!choice.found()) {
    const auto asked = std::find_if(wanted.begin(), wanted.end(),
                                    [&](const auto& w) { return w.first == choice.refused_key; });
    t.fault(asked->first,
            fmt::format("accuracy.{} = {:g}: {}", asked->first, asked->second, choice.failure_reason));
    return false;
  }
  scene.accuracy = fmt::format("{}: {}", choice.name, choice.reason);
  choice.settings.apply(scene.relaxation);
  write_choice(choice, source.root());
  return true;
}

}  // namespace floc
