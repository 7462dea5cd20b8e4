#include "floc/tables/elastic_fits.h"

#include <cmath>
#include <type_traits>

namespace floc {
namespace {

/// Finds the state with which the fit to a branch is compared. Returns the moduli of this state in the unit of the
/// pressures of `path`.
/// 1. If `state` is not empty, it is the name of the state file.
/// 2. Otherwise row number `row` of the path names the state file. Returns nothing if this file is not in the directory
/// of the table.
/// @param axis  number (from 0) of the driven axis of an oedometer test; -1 for other load paths
std::optional<StateModuli> find_state(const std::string& state, const PathTable& path, int row, int axis) {
  const auto found = state.empty() ? moduli_of_row(path, row, axis) : std::optional(moduli_of(state, axis));
  return found ? std::optional(in_unit_of(path, *found)) : std::nullopt;
}

/// Returns the modulus K in d ln Phi = dP/K, where Phi is the solid fraction and P the mean stress: B_uniaxial in an
/// oedometer test, otherwise B_S.
double bulk_modulus_of(const StateModuli& state) {
  return state.B_uniaxial.value_or(state.B_S);
}

/// Returns the number (from 0) of the driven axis if all steps of a branch belong to an oedometer test along one axis;
/// otherwise -1.
int driven_axis_of(const PathTable& path, const Loading& branch) {
  int axis = driven_axis(path, branch.rows.back());
  for (std::size_t i = 1; i < branch.rows.size(); ++i)
    if (driven_axis(path, branch.rows[i]) != axis) axis = -1;
  return axis;
}

/// Returns the branch with the mean stresses replaced by the stresses on the driven axis.
Loading against_driven_stress(const PathTable& path, Loading branch) {
  for (std::size_t i = 0; i < branch.rows.size(); ++i)
    branch.curve.P_star[i] *= path.rows[static_cast<std::size_t>(branch.rows[i])].driven_over_mean;
  return branch;
}

/// Returns the points of a branch that were fitted: all points or, if the branch is curved, the points of its straight
/// part.
Loading part_fitted(const Loading& branch, const ElasticFit& fit) {
  if (fit.n_points == 0) return branch;
  const auto part = [&](const auto& all) {
    return std::decay_t<decltype(all)>(all.begin() + fit.first, all.begin() + fit.first + fit.n_points);
  };
  Loading fitted = branch;
  fitted.curve.P_star = part(branch.curve.P_star);
  fitted.curve.phi = part(branch.curve.phi);
  fitted.rows = part(branch.rows);
  return fitted;
}

}  // namespace

std::vector<FittedParameter> ElasticBranch::parameters() const {
  std::vector<FittedParameter> all = fit.parameters;
  if (!driven || !driven->found()) return all;
  all.push_back(driven->parameters.front());
  all.back().name = "M";
  return all;
}

std::vector<std::string> ElasticBranch::warnings() const {
  std::vector<std::string> all = fit.warnings;
  if (!driven) return all;
  if (!driven->found()) all.push_back("the modulus M could not be fitted: " + driven->failure_reason);
  for (const std::string& warning : driven->warnings)
    all.push_back("fit of the modulus M, against the stress on the driven axis: " + warning);
  return all;
}

std::vector<ElasticBranch> elastic_branches(const PathTable& path, const std::string& state) {
  std::vector<ElasticBranch> branches;
  for (const Loading& branch : unloadings(path.rows)) {
    ElasticFit fit = fit_elastic(branch.curve.P_star, branch.curve.phi);
    const Loading fitted = part_fitted(branch, fit);
    const int axis = driven_axis_of(path, branch);
    const auto first = find_state(state, path, fitted.rows.front(), axis);
    const auto last = find_state(state, path, fitted.rows.back(), axis);
    if (fit.is_curved && first && last) hold_against(bulk_modulus_of(*first), bulk_modulus_of(*last), fit);
    const auto middle =
        fit.is_curved ? find_state(state, path, fitted.rows[fitted.rows.size() / 2], axis) : first;
    branches.push_back({branch, fitted, fit, middle});
    if (axis < 0) continue;
    const Loading driven = against_driven_stress(path, branch);
    branches.back().driven = fit_elastic(driven.curve.P_star, driven.curve.phi);
    branches.back().driven_fitted = part_fitted(driven, *branches.back().driven);
  }
  return branches;
}

double distance_from(const StateModuli& state, const ConsolidationCurve& branch) {
  double sum = 0.0;
  for (std::size_t i = 0; i < branch.phi.size(); ++i)
    sum += std::pow(
        std::log(branch.phi[i] / state.phi) - (branch.P_star[i] - state.pressure) / bulk_modulus_of(state), 2);
  return std::sqrt(sum / static_cast<double>(branch.phi.size()));
}

Json as_json(const PathTable& path, const ElasticBranch& branch) {
  Json object;
  object["sample"] = path.name;
  object["refusal"] = branch.fit.found() ? Json(nullptr) : Json(branch.fit.failure_reason);
  object["rows_used"] = branch.branch.rows;
  // The pressure falls along an unloading branch, so the last row has the lowest pressure.
  object["window"] = Json{branch.branch.curve.P_star.back(), branch.branch.curve.P_star.front()};
  object["pressure_unit"] = path.unit.empty() ? Json(nullptr) : Json(path.unit);
  object["n_points"] = branch.branch.rows.size();
  object["fitted_rows"] = branch.fitted.rows;
  object["fitted_window"] = Json{branch.fitted.curve.P_star.back(), branch.fitted.curve.P_star.front()};
  object["stress"] = path.stress.empty() ? Json(nullptr) : Json(path.stress);
  object["parameters"] = parameters_as_json(branch.parameters());
  object["rms"] = branch.fit.found() ? Json(branch.fit.rms) : Json(nullptr);
  object["secant_low"] = number_or_null(branch.fit.secant_low);
  object["secant_high"] = number_or_null(branch.fit.secant_high);
  // Every object contains every key, so that scripts can rely on the keys. If a branch has no value for a key, the
  // value is null.
  object["state"] = nullptr;
  if (branch.state)
    object["state"] = {{"file", branch.state->file},
                       {"B", branch.state->B},
                       {"B_S", branch.state->B_S},
                       {"M", branch.state->M ? Json(*branch.state->M) : Json(nullptr)},
                       {"P", branch.state->pressure},
                       {"phi", branch.state->phi},
                       {"rms", distance_from(*branch.state, branch.fitted.curve)}};
  object["driven_window"] = nullptr;
  if (branch.driven && branch.driven->found())
    object["driven_window"] =
        Json{branch.driven_fitted.curve.P_star.back(), branch.driven_fitted.curve.P_star.front()};
  object["warnings"] = branch.warnings();
  return object;
}

Table elastic_table() {
  return {{"sample", "source", "parameter", "value", "stderr", "low95", "high95", "identified", "unit", "P_low",
           "P_high", "n_points", "rms", "stress"},
          {}};
}

void add_rows(const PathTable& path, const ElasticBranch& b, Table& table) {
  const auto add = [&](const char* source, const FittedParameter& p, const Loading& points, double rms,
                       const std::string& stress) {
    std::vector<TableValue> row = {path.name, std::string(source), p.name};
    for (TableValue& cell : parameter_cells(p)) row.push_back(std::move(cell));
    row.push_back(p.name == "phi_unloaded" || path.unit.empty() ? TableValue() : TableValue(path.unit));
    for (const TableValue& cell :
         std::vector<TableValue>{points.curve.P_star.back(), points.curve.P_star.front(),
                                 static_cast<std::int64_t>(points.rows.size()), rms, or_undefined(stress)})
      row.push_back(cell);
    table.rows.push_back(std::move(row));
  };
  for (const FittedParameter& p : b.parameters())
    if (p.name == "M")
      add("fit", p, b.driven_fitted, b.driven->rms, "driven");
    else
      add("fit", p, b.fitted, b.fit.rms, path.stress);
  if (!b.state) return;
  const double rms = distance_from(*b.state, b.fitted.curve);
  add("state", {"B", b.state->B, {}, {}, {}, true}, b.fitted, rms, path.stress);
  add("state", {"B_S", b.state->B_S, {}, {}, {}, true}, b.fitted, rms, path.stress);
  if (b.state->M && b.driven)
    add("state", {"M", *b.state->M, {}, {}, {}, true}, b.driven_fitted, std::nan(""), "driven");
}

}  // namespace floc
