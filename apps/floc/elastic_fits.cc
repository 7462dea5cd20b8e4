#include "elastic_fits.h"

#include <cmath>
#include <type_traits>

namespace floc {
namespace {

/// The state to compare with: the one asked for, else that of the branch's first row if it lies beside the
/// table.
std::optional<StateModuli> find_state(const std::string& state, const PathTable& path, int row) {
  return state.empty() ? moduli_of_row(path, row) : std::optional(moduli_of(state));
}

/// The points of a branch that were fitted: all of them, or the straight part of a curved one.
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

std::vector<ElasticBranch> elastic_branches(const PathTable& path, const std::string& state) {
  std::vector<ElasticBranch> branches;
  for (const Loading& branch : unloadings(path.rows)) {
    ElasticFit fit = fit_elastic(branch.curve.P_star, branch.curve.phi);
    const Loading fitted = part_fitted(branch, fit);
    const auto first = find_state(state, path, fitted.rows.front());
    const auto last = find_state(state, path, fitted.rows.back());
    if (fit.is_curved && first && last) hold_against(first->B_S, last->B_S, fit);
    const auto middle = fit.is_curved ? find_state(state, path, fitted.rows[fitted.rows.size() / 2]) : first;
    branches.push_back({branch, fitted, fit, middle});
  }
  return branches;
}

double distance_from(const StateModuli& state, const ConsolidationCurve& branch) {
  double sum = 0.0;
  for (std::size_t i = 0; i < branch.phi.size(); ++i)
    sum += std::pow(std::log(branch.phi[i] / state.phi) - (branch.P_star[i] - state.pressure) / state.B_S, 2);
  return std::sqrt(sum / static_cast<double>(branch.phi.size()));
}

Json as_json(const PathTable& path, const ElasticBranch& branch) {
  Json object;
  object["sample"] = path.name;
  object["refusal"] = branch.fit.found() ? Json(nullptr) : Json(branch.fit.refusal);
  object["rows_used"] = branch.branch.rows;
  object["window"] = Json{branch.branch.curve.P_star.back(), branch.branch.curve.P_star.front()};
  object["pressure_unit"] = path.unit.empty() ? Json(nullptr) : Json(path.unit);
  object["n_points"] = branch.branch.rows.size();
  object["fitted_rows"] = branch.fitted.rows;
  object["fitted_window"] = Json{branch.fitted.curve.P_star.back(), branch.fitted.curve.P_star.front()};
  object["parameters"] = parameters_as_json(branch.fit.parameters);
  object["rms"] = branch.fit.found() ? Json(branch.fit.rms) : Json(nullptr);
  object["secant_low"] = number_or_null(branch.fit.secant_low);
  object["secant_high"] = number_or_null(branch.fit.secant_high);
  object["state"] = nullptr;
  if (branch.state)
    object["state"] = {
        {"file", branch.state->file}, {"B", branch.state->B},
        {"B_S", branch.state->B_S},   {"P", branch.state->pressure},
        {"phi", branch.state->phi},   {"rms", distance_from(*branch.state, branch.fitted.curve)}};
  object["warnings"] = branch.fit.warnings;
  return object;
}

}  // namespace floc
