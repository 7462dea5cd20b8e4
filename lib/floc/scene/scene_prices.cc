#include "floc/scene/scene_prices.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "floc/base/read_text.h"
#include "floc/base/split.h"
#include "floc/loading/run_plan.h"
#include "floc/scene/cell_defaults.h"
#include "floc/scene/derived_groups.h"
#include "floc/scene/scene_kind.h"
#include "floc/scene/scene_observables.h"
#include "floc/scene/scene_scales.h"

namespace floc {
namespace {

const char* stiffness_name(const Scene& scene) {
  if (scene.law.adheres()) return "a K_N/F0";
  return scene.law.force_exponent() != 1.0 ? "(E~/P)^(2/3)" : "K_N/P";
}

/// Returns the options of the relaxation, with the mass of the cell and the caps on its strain rate, in each part of a
/// run: first in the assembly, then in each stage of the load path.
std::vector<RelaxationOptions> motions_of_cell(const Scene& scene) {
  if (scene.assembly.box) return {};
  std::vector<RelaxationOptions> parts = {scene.assembly.cell.applied_to(scene.relaxation)};
  for (const LoadStage& stage : scene.load) parts.push_back(stage.cell.applied_to(scene.relaxation));
  return parts;
}

/// Returns the first stiffness number in a table; NaN if the table has none.
double measured_kappa(const PriceTable& table) {
  for (const PriceRow& row : table.rows)
    if (std::isfinite(row.kappa)) return row.kappa;
  return std::numeric_limits<double>::quiet_NaN();
}

std::string errors_in(const PriceTable& table) {
  return table.is_shipped ? "table of errors shipped with floc" : table.name();
}

/// A table of prices is measured on other scenes of the same kind. This function returns whether the cell of a scene
/// can be compared with the cells in those scenes. This is possible for cohesive grains, because their tables are
/// measured with the default cap on the strain rate. For grains without adhesion the default cap is on the inertial
/// number, and its value differs between materials.
bool has_default_cells(const Scene& scene) {
  return default_cap(scene).strain_rate_cap.has_value();
}

/// Returns the reason why a table of prices does not apply to the cell of a scene; empty if it applies.
std::string problem_of_cell(const PriceTable& table, const Scene& scene) {
  if (!has_default_cells(scene)) return "";
  for (const RelaxationOptions& part : motions_of_cell(scene))
    if (part.inertial_number_cap)
      return fmt::format(
          "strain_rate_cap is required in place of inertial_number_cap, because the errors in the {} were "
          "measured with a strain_rate_cap",
          table.name());
  for (const CellFactors& cell : cells_of(scene))
    if (const std::string problem = problem_of_factors(table, cell); !problem.empty()) return problem;
  return "";
}

/// Returns the reason why a table of prices for the kind of a scene does not apply to the scene; empty if it applies.
std::string problem_of(const PriceTable& table, const Scene& scene) {
  // Stages may change the contact law.
  Scene present = scene;
  for (const PlannedEquilibrium& planned : plan_run(scene.assembly, scene.law, scene.load, scene.dimension)) {
    present.law = planned.law;
    const std::optional<double> kappa = stiffness_number(present);
    if (kappa && std::isnan(measured_kappa(table)))
      return fmt::format(
          "the stiffness number {} is {:g}, but the column kappa of the {} is empty: expected the "
          "stiffness number of the scene that the table was measured on",
          stiffness_name(present), *kappa, table.name());
    if (kappa && !covers_stiffness(table, *kappa))
      return fmt::format(
          "the stiffness number {} = {:g}{} is outside the range of the {}, which was measured at {:g} and "
          "applies "
          "within a factor of ten",
          stiffness_name(present), *kappa,
          planned.branch == "assembly" ? "" : fmt::format(" in the stage {}", planned.branch), errors_in(table),
          measured_kappa(table));
  }
  return problem_of_cell(table, scene);
}

/// Returns the kinds of scenes with shipped tables that are most similar to a kind: those that have the most first words
/// in common with it. Tables of cemented grains are left out, because they describe lattices and no scenes.
std::vector<std::string> similar_kinds(const std::string& kind) {
  const std::vector<std::string> words = split(kind, '-');
  std::vector<std::string> similar;
  std::ptrdiff_t most = 0;
  for (const std::string& other : priced_kinds()) {
    if (other.ends_with("-cemented")) continue;
    const std::vector<std::string> others = split(other, '-');
    const std::ptrdiff_t equal =
        std::mismatch(words.begin(), words.end(), others.begin(), others.end()).first - words.begin();
    if (equal < most) continue;
    if (equal > most) similar.clear();
    most = equal;
    similar.push_back(other);
  }
  return similar;
}

}  // namespace

std::optional<double> stiffness_number(const Scene& scene) {
  if (scene.has_contact_dynamics()) return std::nullopt;
  const double a = scene.grains.largest(), modulus = scene.law.contact_modulus(scene.dimension, a);
  if (scene.law.adheres()) return std::pow(a, scene.dimension - 1) * modulus / pull_off_force(scene);
  if (scene.law.force_exponent() != 1.0) return hertz_kappa(scene, scene.assembly.pressure);
  return modulus / scene.assembly.pressure;
}

std::vector<CellFactors> cells_of(const Scene& scene) {
  if (!has_default_cells(scene)) return {};
  std::vector<CellFactors> cells;
  for (const RelaxationOptions& part : motions_of_cell(scene))
    cells.push_back(
        {part.cell_mass / kLoadCellMass, part.strain_rate_cap.value_or(kStrainRateCap) / kStrainRateCap});
  // The mass of the cell during the assembly influences which packing is made, but not the accuracy. This mass is
  // therefore treated as the default mass.
  if (!cells.empty()) cells.front().mass = 1.0;
  return cells;
}

ScenePrices prices_of(const Scene& scene, const std::string& file) {
  const std::string kind = scene_kind(scene);
  std::optional<PriceTable> table =
      file.empty() ? shipped_prices(kind) : read_price_table(read_text(file), file);
  if (!table)
    return {std::nullopt,
            fmt::format(
                "the scene is of the kind {}, for which no table of prices is shipped with floc: expected a "
                "table for this kind, written by floc tradeoff (--prices FILE). The most similar kinds with a "
                "table are {}",
                kind, fmt::join(similar_kinds(kind), ", "))};
  if (table->kind.empty())
    return {
        std::nullopt,
        fmt::format("the {} has no column kind, because an older version of floc has written it: expected a "
                    "table that floc tradeoff --format csv of this version of floc has written",
                    table->name())};
  if (table->kind != kind)
    return {std::nullopt, fmt::format("the scene is of the kind {}, but the {} describes scenes of the kind "
                                      "{}",
                                      kind, table->name(), table->kind)};
  std::erase_if(table->rows, [&](const PriceRow& row) { return !has_observable(scene, row.observable); });
  const std::string problem = problem_of(*table, scene);
  return problem.empty() ? ScenePrices{std::move(table), ""} : ScenePrices{std::nullopt, problem};
}

}  // namespace floc
