#include "floc/tradeoff/fitted_path.h"

#include <cmath>
#include <limits>
#include <optional>

#include "floc/fitting/consolidation.h"
#include "floc/packing/equilibrium.h"

namespace floc {
namespace {

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kMinSamples = 3;
using Fitted = std::array<double, kFittedNames.size()>;

/// Returns the indices of the states of the first loading: of the last assembled state, then of the states of the first
/// stage. The result is empty if the pressure does not increase in this stage.
std::vector<std::size_t> first_loading(const SamplePath& path) {
  std::vector<std::size_t> at;
  for (std::size_t k = 0; k < path.states.size() && path.states[k].stage <= 0; ++k) {
    const double pressure = path.states[k].state.target_stress.mean();
    if (path.states[k].stage < 0) at.clear();
    if (!at.empty() && pressure <= path.states[at.back()].state.target_stress.mean()) return {};
    if (pressure > 0.0) at.push_back(k);
  }
  return at;
}

/// Returns 1/Phi (inverse solid fraction) against reduced pressure in the first loading, with its mean over the
/// samples.
/// @param left_out  index of the sample that the curve leaves out; absent if it contains all samples
ConsolidationCurve curve_without(const std::vector<const SamplePath*>& paths,
                                 std::optional<std::size_t> left_out) {
  ConsolidationCurve curve;
  const std::vector<std::size_t> states = first_loading(*paths.front());
  const auto n = static_cast<Eigen::Index>(paths.size() - (left_out ? 1 : 0));
  curve.samples.resize(static_cast<Eigen::Index>(states.size()), n);
  for (std::size_t k = 0; k < states.size(); ++k) {
    const State<2>& state = paths.front()->states[states[k]].state;
    curve.P_star.push_back(reduced_pressure<2>(state.packing, state.target_stress.mean()));
    Eigen::Index column = 0;
    for (std::size_t s = 0; s < paths.size(); ++s)
      if (s != left_out)
        curve.samples(static_cast<Eigen::Index>(k), column++) =
            1.0 / paths[s]->states[states[k]].observation[kPhi];
    curve.phi.push_back(1.0 / curve.samples.row(static_cast<Eigen::Index>(k)).mean());
  }
  return curve;
}

/// Returns the parameters lambda, alpha and Phi_max of the full consolidation law. It is fitted to the states in a
/// range of reduced pressures. The values are NaN if the fit is not possible.
Fitted fit(const ConsolidationCurve& curve, const PressureWindow& window) {
  std::vector<double> log_P, y;
  for (std::size_t k = 0; k < curve.P_star.size(); ++k)
    if (window.first <= curve.P_star[k] && curve.P_star[k] <= window.second)
      log_P.push_back(std::log(curve.P_star[k])), y.push_back(1.0 / curve.phi[k]);
  Fitted values;
  values.fill(kUndefined);
  const auto n = static_cast<Eigen::Index>(y.size());
  if (n <= n_parameters(ConsolidationLaw::full)) return values;
  const auto solution = solve_law(
      ConsolidationLaw::full,
      {Eigen::VectorXd::Map(log_P.data(), n), Eigen::VectorXd::Map(y.data(), n), Eigen::VectorXd::Ones(n)});
  if (solution) values = {std::exp(solution->theta[0]), std::exp(solution->theta[1]), 1.0 / solution->theta[2]};
  return values;
}

}  // namespace

std::optional<PressureWindow> fit_window(const std::vector<const SamplePath*>& references) {
  if (references.size() < kMinSamples || first_loading(*references.front()).empty()) return std::nullopt;
  const ConsolidationFit whole = fit_consolidation(curve_without(references, std::nullopt), {});
  if (!whole.found() || whole.reported_law != ConsolidationLaw::full) return std::nullopt;
  return PressureWindow(whole.window_low, whole.window_high);
}

std::array<MeanDifference, kFittedNames.size()> compare_fits(const std::vector<const SamplePath*>& references,
                                                             const std::vector<const SamplePath*>& paths,
                                                             const PressureWindow& window) {
  std::array<MeanDifference, kFittedNames.size()> out;
  const std::size_t n = references.size();
  if (n < kMinSamples) return out;
  const auto differences = [&](std::optional<std::size_t> left_out) {
    const Fitted truth = fit(curve_without(references, left_out), window);
    Fitted values = fit(curve_without(paths, left_out), window);
    for (std::size_t p = 0; p < values.size(); ++p) values[p] = values[p] / truth[p] - 1.0;
    return values;
  };
  const Fitted all = differences(std::nullopt);
  std::vector<Fitted> without;
  for (std::size_t s = 0; s < n; ++s) without.push_back(differences(s));
  for (std::size_t p = 0; p < all.size(); ++p) {
    std::vector<double> values;
    for (const Fitted& f : without) values.push_back(f[p]);
    const MeanDifference spread = mean_of(values);
    if (!std::isfinite(all[p]) || spread.n < static_cast<int>(n)) continue;
    // Jackknife: a mean over n samples changes by 1/(n - 1) of the deviation of a sample if this sample is left out.
    // The scatter of the fits with one sample left out is therefore multiplied by n - 1.
    const auto scale = static_cast<double>(n - 1);
    out[p] = {all[p], scale * spread.standard_error, scale * spread.error95, spread.n};
  }
  return out;
}

}  // namespace floc
