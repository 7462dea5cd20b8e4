#include "floc/tradeoff/path_fits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "floc/fitting/consolidation.h"
#include "floc/fitting/oedometer_test.h"
#include "floc/fitting/shear_test.h"

namespace floc {
namespace {

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kMinSamples = 3;
using Fitted = ConsolidationValues;

/// Returns the indices of the states of the first loading: the last state of the assembly and all states of the first
/// stage. The result is empty if the pressure does not increase in this stage.
std::vector<std::size_t> first_loading(const SamplePath& path) {
  std::vector<std::size_t> at;
  for (std::size_t k = 0; k < path.states.size() && path.states[k].stage <= 0; ++k) {
    const double pressure = path.states[k].driven_stress;
    if (path.states[k].stage < 0) at.clear();
    if (!at.empty() && pressure <= path.states[at.back()].driven_stress) return {};
    if (pressure > 0.0) at.push_back(k);
  }
  return at;
}

/// Returns the curve of 1/Phi (inverse solid fraction, averaged over the samples) against the reduced pressure in the
/// first loading.
/// @param left_out  index of a sample that is left out of the mean; if absent, all samples are included
ConsolidationCurve curve_without(const std::vector<const SamplePath*>& paths,
                                 std::optional<std::size_t> left_out) {
  ConsolidationCurve curve;
  const std::vector<std::size_t> states = first_loading(*paths.front());
  const auto n = static_cast<Eigen::Index>(paths.size() - (left_out ? 1 : 0));
  curve.samples.resize(static_cast<Eigen::Index>(states.size()), n);
  for (std::size_t k = 0; k < states.size(); ++k) {
    curve.P_star.push_back(paths.front()->states[states[k]].reduced_pressure);
    Eigen::Index column = 0;
    for (std::size_t s = 0; s < paths.size(); ++s)
      if (s != left_out)
        curve.samples(static_cast<Eigen::Index>(k), column++) =
            1.0 / paths[s]->states[states[k]].observation[kPhi];
    curve.phi.push_back(1.0 / curve.samples.row(static_cast<Eigen::Index>(k)).mean());
  }
  return curve;
}

/// Returns the parameters lambda, alpha and Phi_max of the full consolidation law, fitted to the states in a range of
/// reduced pressures. The values are NaN if the fit is not possible.
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

/// Returns the relative differences between `values` and the reference values `from`.
Fitted differences(Fitted values, const Fitted& from) {
  for (std::size_t p = 0; p < values.size(); ++p) values[p] = values[p] / from[p] - 1.0;
  return values;
}

/// Returns differences with their standard errors, which are estimated by the jackknife. Leaving out one of n samples
/// changes a mean by 1/(n - 1) times the deviation of this sample. Consider n values, each computed without one of the
/// samples. The standard error is n - 1 times the standard error of the mean of these values.
/// @param value  function that returns the differences without the sample of a given index or, without an index, the
/// differences of all samples
template <class Value>
std::array<MeanDifference, 3> jackknife(std::size_t n, const Value& value) {
  std::array<MeanDifference, 3> out;
  if (n < kMinSamples) return out;
  const Fitted all = value(std::nullopt);
  std::vector<Fitted> without;
  for (std::size_t s = 0; s < n; ++s) without.push_back(value(s));
  for (std::size_t p = 0; p < all.size(); ++p) {
    std::vector<double> values;
    for (const Fitted& f : without) values.push_back(f[p]);
    const MeanDifference spread = mean_of(values);
    if (!std::isfinite(all[p]) || spread.n < static_cast<int>(n)) continue;
    const auto scale = static_cast<double>(n - 1);
    out[p] = {all[p], scale * spread.standard_error, scale * spread.error95, spread.n};
  }
  return out;
}

/// Returns the stresses and strains along the first stage whose control is one of `controls`. The first point is the
/// state from which the stage began.
std::vector<ShearPoint> points_of_test(const SamplePath& path, std::initializer_list<const char*> controls) {
  std::vector<ShearPoint> points;
  int stage = -1;
  for (const ObservedState& s : path.states) {
    const bool is_test = std::find(controls.begin(), controls.end(), s.control) != controls.end();
    if (!is_test || !s.test || (stage >= 0 && s.stage != stage)) continue;
    if (points.empty()) points.push_back(*s.start_of_test);
    points.push_back(*s.test);
    stage = s.stage;
  }
  return points;
}

double parameter(const std::vector<FittedParameter>& parameters, const std::string& name) {
  for (const FittedParameter& p : parameters)
    if (p.name == name) return p.value.value_or(kUndefined);
  return kUndefined;
}

double oedometer_value(const SamplePath& path, const char* name) {
  const std::vector<ShearPoint> points = points_of_test(path, {"oedometric"});
  if (points.size() < 3) return kUndefined;
  return parameter(evaluate_oedometer_test(points, std::nullopt).parameters, name);
}

double dilatancy(const SamplePath& path) {
  const std::vector<ShearPoint> points = points_of_test(path, {"triaxial"});
  return parameter(evaluate_shear_test(points, {}).parameters, "dilatancy_angle");
}

/// Returns the absolute value of the stress ratio in each state of the first shear test, in order.
std::vector<double> stress_ratios(const SamplePath& path) {
  std::vector<double> ratios;
  int stage = -1;
  for (const ObservedState& s : path.states) {
    if (!std::isfinite(s.observation[kStressRatio]) || s.control == "oedometric") continue;
    if (stage >= 0 && s.stage != stage) break;
    ratios.push_back(std::abs(s.observation[kStressRatio]));
    stage = s.stage;
  }
  return ratios;
}

double peak_ratio(const SamplePath& path) {
  const std::vector<double> ratios = stress_ratios(path);
  return ratios.empty() ? kUndefined : *std::max_element(ratios.begin(), ratios.end());
}

/// Returns the mean stress ratio over the last quarter of the states of the first shear test; NaN if this quarter has
/// fewer than three states.
double critical_ratio(const SamplePath& path) {
  const std::vector<double> ratios = stress_ratios(path);
  const std::size_t n = ratios.size() / 4;
  if (n < 3) return kUndefined;
  return std::accumulate(ratios.end() - static_cast<std::ptrdiff_t>(n), ratios.end(), 0.0) /
         static_cast<double>(n);
}

}  // namespace

std::optional<PressureWindow> fit_window(const std::vector<const SamplePath*>& references) {
  if (references.size() < kMinSamples || first_loading(*references.front()).empty()) return std::nullopt;
  const ConsolidationFit whole = fit_consolidation(curve_without(references, std::nullopt), {});
  if (!whole.found() || whole.reported_law != ConsolidationLaw::full) return std::nullopt;
  return PressureWindow(whole.window_low, whole.window_high);
}

ConsolidationValues fitted_consolidation(const std::vector<const SamplePath*>& paths,
                                         const PressureWindow& window) {
  return fit(curve_without(paths, std::nullopt), window);
}

std::array<MeanDifference, 3> compare_fits(const std::vector<const SamplePath*>& references,
                                           const std::vector<const SamplePath*>& paths,
                                           const PressureWindow& window) {
  // A sample and its reference path have one seed, so part of their scatter is common to both. They are left out
  // together, so that this part cancels in the difference. Separate jackknife errors of the two fits, added in squares,
  // would include this part twice.
  return jackknife(references.size(), [&](std::optional<std::size_t> left_out) {
    return differences(fit(curve_without(paths, left_out), window),
                       fit(curve_without(references, left_out), window));
  });
}

std::array<MeanDifference, 3> sampling_errors_of_fits(const std::vector<const SamplePath*>& paths,
                                                      const PressureWindow& window) {
  // Every difference is relative to the fit to all samples. The jackknife therefore gives the standard error of each
  // parameter divided by the parameter.
  const Fitted whole = fitted_consolidation(paths, window);
  return jackknife(paths.size(), [&](std::optional<std::size_t> left_out) {
    return differences(fit(curve_without(paths, left_out), window), whole);
  });
}

double path_value(int observable, const SamplePath& path) {
  switch (observable) {
    case kK0:
      return oedometer_value(path, "K0");
    case kConstrainedModulus:
      return oedometer_value(path, "constrained_modulus");
    case kPeakRatio:
      return peak_ratio(path);
    case kCriticalRatio:
      return critical_ratio(path);
    case kDilatancy:
      return dilatancy(path);
    default:
      return kUndefined;
  }
}

}  // namespace floc
