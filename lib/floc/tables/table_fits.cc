#include "floc/tables/table_fits.h"

#include <fmt/format.h>

#include <algorithm>

#include "floc/base/error.h"
#include "floc/fitting/pressure_cycle.h"
#include "floc/fitting/segments.h"
#include "floc/structure/force_distribution.h"

namespace floc {
namespace {

void add_rows(const PathTable& path, const PressureCycle& cycle, Table& table) {
  const TableValue unit = or_undefined(path.unit);
  const TableValue work = or_undefined(cycle.work);
  for (std::size_t k = 0; k < cycle.P.size(); ++k)
    table.rows.push_back({path.name, ranges(cycle.up.rows), ranges(cycle.down.rows), cycle.P[k],
                          cycle.phi_up[k], cycle.phi_down[k], cycle.phi_down[k] - cycle.phi_up[k],
                          cycle.up.curve.P_star.back(), work, unit, path.stress_of_rows()});
}

Json budget_as_json(const CompactionFit& fit) {
  Json budget = Json::object();
  for (const CompactionErrorParts& parts : fit.error_parts)
    budget[parts.name] = {{"scatter", number_or_null(parts.scatter)},
                          {"law", fit.errors_from_runs ? number_or_null(parts.law) : Json(nullptr)},
                          {"plateau", number_or_null(parts.plateau)},
                          {"limited_by", limit_of(parts)}};
  return budget;
}

/// Returns the rows of a first loading up to the end of its virgin line. Beyond this line, the curve bends towards the
/// densest state.
Loading up_to_virgin_line(Loading loading) {
  constexpr std::size_t kLeast = 5;
  if (loading.rows.size() < kLeast) return loading;
  const auto regimes = find_segments(law_points(loading.curve, Weighting::between));
  if (!regimes || regimes->all_in_one || regimes->end_of_two == regimes->n_plateau) return loading;
  const auto n = static_cast<std::size_t>(regimes->end_of_two);
  loading.rows.resize(n);
  loading.curve.P_star.resize(n);
  loading.curve.phi.resize(n);
  return loading;
}

/// Returns the largest pressure before a branch. The cell is empty for a first loading, which has no earlier pressure.
TableValue largest_before(const ReloadingFit& reloading) {
  return reloading.is_first_loading() ? TableValue() : TableValue(reloading.branch.largest_before);
}

const char* branch_name(const ReloadingFit& reloading) {
  return reloading.is_first_loading() ? "first loading" : "reloading";
}

}  // namespace

std::vector<ReloadingFit> preconsolidation_fits(const PathTable& path, const std::string& branch) {
  std::vector<Reloading> branches;
  if (branch != "first") branches = reloadings(path.rows);
  const bool with_first = branch == "first" || branch == "all" || (branch.empty() && branches.empty());
  if (with_first) branches.push_back({up_to_virgin_line(first_loading(path.rows)), 0.0});
  std::vector<ReloadingFit> fits;
  for (const Reloading& one : branches)
    fits.push_back({one, fit_preconsolidation(one.loading.curve.P_star, one.loading.curve.phi)});
  return fits;
}

Json as_json(const PathTable& path, const ReloadingFit& reloading) {
  const auto& [branch, fit] = reloading;
  Json object;
  object["sample"] = path.name;
  object["refusal"] = fit.found() ? Json(nullptr) : Json(fit.failure_reason);
  object["rows_used"] = branch.loading.rows;
  object["largest_before"] = reloading.is_first_loading() ? Json(nullptr) : Json(branch.largest_before);
  object["pressure_unit"] = path.unit.empty() ? Json(nullptr) : Json(path.unit);
  object["stress"] = path.stress.empty() ? Json(nullptr) : Json(path.stress);
  object["n_points"] = branch.loading.rows.size();
  object["parameters"] = parameters_as_json(fit.parameters);
  object["rms"] = fit.found() ? Json(fit.rms) : Json(nullptr);
  object["warnings"] = fit.warnings;
  object["branch"] = branch_name(reloading);
  return object;
}

Table cycle_table() {
  return {{"sample", "rows_up", "rows_down", "P", "phi_up", "phi_down", "dphi_irr", "P_turn", "work", "unit",
           "stress"},
          {}};
}

int add_cycles(const PathTable& path, Table& table) {
  int n = 0;
  for (const PressureCycle& cycle : pressure_cycles(path.rows)) {
    if (cycle.P.empty()) continue;
    add_rows(path, cycle, table);
    ++n;
  }
  return n;
}

const char* limit_of(const CompactionErrorParts& parts) {
  if (parts.plateau > std::max(parts.scatter, parts.law)) return "plateau";
  return parts.law > parts.scatter ? "law" : "samples";
}

CompactedSample compacted_sample(const std::string& place, double e, double p, double sc, double se) {
  const auto positive = [&](double value, const char* name) {
    if (value > 0) return value;
    throw InputError(place, fmt::format("{} = {}: expected a positive number", name, value));
  };
  return {positive(e, "e"), positive(p, "p"), positive(sc, "sc"), positive(se, "se")};
}

Json as_json(const std::string& name, const CompactionFit& fit, const CompactionReference& reference) {
  Json object;
  object["sample"] = name;
  object["refusal"] = fit.found() ? Json(nullptr) : Json(fit.failure_reason);
  object["rows_used"] = fit.used;
  object["n_points"] = fit.used.size();
  object["held"] = {{"p_D", reference.p_D}, {"eta_m", reference.eta_m}};
  object["parameters"] = parameters_as_json(fit.parameters);
  object["correlation"] = Json::object();
  for (std::size_t i = 0; i < fit.parameters.size(); ++i)
    for (std::size_t j = 0; j < fit.parameters.size(); ++j)
      object["correlation"][fit.parameters[i].name][fit.parameters[j].name] =
          number_or_null(fit.correlation(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
  object["rms"] = fit.found() ? Json(fit.rms) : Json(nullptr);
  object["plateau"] = reference.plateau == PlateauPressure::own ? "p" : "p_crit";
  object["errors_from"] = fit.errors_from_runs ? "runs" : "residuals";
  object["error_budget"] = budget_as_json(fit);
  object["profiled"] = fit.profiled;
  object["rows_left_out"] = Json::object();
  if (!fit.below_p_0.empty()) object["rows_left_out"]["below_p_0"] = fit.below_p_0;
  if (!fit.beside_plateau.empty()) object["rows_left_out"]["beside_plateau"] = fit.beside_plateau;
  object["warnings"] = fit.warnings;
  return object;
}

std::vector<ForceFit> fit_forms(const std::vector<double>& forces, const ForceDistributionOptions& options) {
  const std::vector<double> positive = sizes_of(forces, 1.0), negative = sizes_of(forces, -1.0);
  const auto wanted = [&](const char* form) { return options.form == "all" || options.form == form; };
  std::vector<ForceFit> fits;
  const auto add_tail = [&](const char* form, const std::vector<double>& sizes) {
    const double threshold = options.threshold.value_or(mean_size(sizes));
    fits.push_back(fit_exponential_tail(form, sizes, threshold, options.fit));
  };
  if (wanted("tails") && !positive.empty()) add_tail("tail_positive", positive);
  if (wanted("tails") && !negative.empty()) add_tail("tail_negative", negative);
  if (wanted("power-exponential"))
    fits.push_back(fit_compressive_forces(power_exponential(), positive, options.fit));
  if (wanted("quadratic-exponential"))
    fits.push_back(fit_compressive_forces(quadratic_exponential(), positive, options.fit));
  return fits;
}

Json as_json(const std::string& name, const std::vector<double>& forces, const ForceFit& fit) {
  const bool is_tail = fit.form.starts_with("tail");
  Json object;
  object["sample"] = name;
  object["form"] = fit.form;
  object["refusal"] = fit.found() ? Json(nullptr) : Json(fit.failure_reason);
  object["n_positive"] = sizes_of(forces, 1.0).size();
  object["n_negative"] = sizes_of(forces, -1.0).size();
  object["n_points"] = fit.n;
  object[is_tail ? "threshold" : "mean"] = fit.mean;
  object["parameters"] = parameters_as_json(fit.parameters);
  object["log_likelihood"] = fit.found() ? Json(fit.log_likelihood) : Json(nullptr);
  object["ks"] = fit.found() ? Json(fit.distance) : Json(nullptr);
  object["p_value"] = fit.found() ? Json(fit.p_value) : Json(nullptr);
  return object;
}

Table preconsolidation_table() {
  return {{"sample", "parameter", "value", "stderr", "low95", "high95", "identified", "unit", "largest_before",
           "n_points", "rms", "stress", "branch"},
          {}};
}

void add_rows(const PathTable& path, const ReloadingFit& reloading, Table& table) {
  const auto& [branch, fit] = reloading;
  for (const FittedParameter& p : fit.parameters) {
    std::vector<TableValue> row = {path.name, p.name};
    for (TableValue& cell : parameter_cells(p)) row.push_back(std::move(cell));
    row.push_back(p.name.starts_with("P_c") ? or_undefined(path.unit) : TableValue());
    for (const TableValue& cell : std::vector<TableValue>{
             largest_before(reloading), static_cast<std::int64_t>(branch.loading.rows.size()), fit.rms,
             path.stress_of_rows(), branch_name(reloading)})
      row.push_back(cell);
    table.rows.push_back(std::move(row));
  }
}

Table compaction_table() {
  return {{"sample", "parameter", "value", "stderr", "low95", "high95", "identified", "n_points", "rms"}, {}};
}

void add_rows(const std::string& name, const CompactionFit& fit, Table& table) {
  for (const FittedParameter& p : fit.parameters) {
    std::vector<TableValue> row = {name, p.name};
    const std::vector<TableValue> cells = parameter_cells(p);
    row.insert(row.end(), cells.begin(), cells.end());
    row.insert(row.end(), {static_cast<std::int64_t>(fit.used.size()), fit.rms});
    table.rows.push_back(std::move(row));
  }
}

Table force_table() {
  return {{"sample", "form", "parameter", "value", "stderr", "low95", "high95", "identified", "n_points",
           "unit_force", "log_likelihood", "ks", "p_value"},
          {}};
}

void add_rows(const std::string& name, const ForceFit& fit, Table& table) {
  for (const FittedParameter& p : fit.parameters) {
    std::vector<TableValue> row = {name, fit.form, p.name};
    for (TableValue& cell : parameter_cells(p)) row.push_back(std::move(cell));
    for (const TableValue& cell :
         std::vector<TableValue>{std::int64_t{fit.n}, fit.mean, fit.log_likelihood, fit.distance, fit.p_value})
      row.push_back(cell);
    table.rows.push_back(std::move(row));
  }
}

}  // namespace floc
