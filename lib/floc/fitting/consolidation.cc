#include "floc/fitting/consolidation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "floc/fitting/consolidation_bootstrap.h"
#include "floc/fitting/consolidation_parameters.h"
#include "floc/fitting/law_estimate.h"
#include "floc/fitting/window_checks.h"

namespace floc {
namespace {

using Law = ConsolidationLaw;

/// Smallest numbers of samples for which the weights and the standard errors of a fit to their mean curve are computed
/// from the scatter between samples.
constexpr Eigen::Index kMinForWeights = 3, kMinForErrors = 2;

const char* name_of(Law law) {
  return law == Law::log ? "log" : law == Law::power ? "power" : "full";
}

const char* place_of(Law law) {
  return law == Law::log ? "regime II" : law == Law::power ? "regime III" : "the window";
}

Weighting weighting_of(const ConsolidationCurve& curve, const ConsolidationOptions& options) {
  if (options.weighting != Weighting::automatic) return options.weighting;
  return curve.samples.cols() >= kMinForWeights ? Weighting::scatter : Weighting::relative;
}

/// Returns the deviation of each sample (columns) from the mean of the samples, at each point of the curve (rows).
Eigen::MatrixXd deviations_of(const Eigen::MatrixXd& samples) {
  return samples.colwise() - samples.rowwise().mean();
}

/// Returns the variance of 1/Phi between samples at each pressure. With a few samples, the variance at a single
/// pressure is inaccurate. It is therefore averaged over five neighbouring pressures, and raised to at least a tenth of
/// its mean over all pressures.
Eigen::VectorXd smooth_variance(const Eigen::MatrixXd& samples) {
  constexpr Eigen::Index kReach = 2;
  constexpr double kMinRelativeVariance = 0.1;
  const Eigen::VectorXd own =
      deviations_of(samples).rowwise().squaredNorm() / static_cast<double>(samples.cols() - 1);
  const Eigen::Index n = own.size();
  Eigen::VectorXd smooth(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index first = std::max<Eigen::Index>(i - kReach, 0);
    smooth[i] = own.segment(first, std::min(i + kReach + 1, n) - first).mean();
  }
  return smooth.cwiseMax(kMinRelativeVariance * smooth.mean());
}

/// Returns the factor by which the residual of each point of a curve is multiplied. The mean square of these factors is
/// one.
Eigen::VectorXd weights_of(const ConsolidationCurve& curve, const Eigen::VectorXd& y, Weighting weighting) {
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(y.size());
  if (weighting == Weighting::relative) weights = y.cwiseInverse();
  if (weighting == Weighting::between) weights = y.cwiseSqrt().cwiseInverse();
  if (weighting == Weighting::scatter) {
    const Eigen::VectorXd variance = smooth_variance(curve.samples);
    if (variance.mean() > 0.0) weights = variance.cwiseSqrt().cwiseInverse();
  }
  return weights / std::sqrt(weights.squaredNorm() / static_cast<double>(weights.size()));
}

Window given_window(const ConsolidationCurve& curve, std::pair<double, double> window) {
  // Relative tolerance of the bounds of the window. Users type a bound with few digits; with the tolerance, the window
  // includes the point whose rounded pressure is the bound.
  constexpr double kTyped = 1e-3;
  const auto inside = [&](double P) {
    return P >= window.first * (1 - kTyped) && P <= window.second * (1 + kTyped);
  };
  const auto begin = std::find_if(curve.P_star.begin(), curve.P_star.end(), inside);
  return {static_cast<int>(begin - curve.P_star.begin()),
          static_cast<int>(std::count_if(begin, curve.P_star.end(), inside)), 0};
}

/// Returns the window of points to which a consolidation law is fitted: the points of those regimes that the law
/// describes. @param n  number of points of the curve
Window window_of(Law law, const Regimes& regimes, int n) {
  const int k = regimes.n_plateau;
  if (law == Law::full) return {k, n - k, k};
  const int lagging = regimes.n_lagging;
  if (law == Law::log) return {k + lagging, regimes.end_of_two - k - lagging, k, lagging};
  return {regimes.end_of_two, n - regimes.end_of_two, 0};
}

std::string too_few(Law law, int n) {
  return fmt::format(
      "there are {} pressures in {}, but a fit of the {} law needs {}: choose a wider range of pressures with "
      "--window lo,hi or a load path with more pressures",
      n, place_of(law), name_of(law), n_parameters(law) + 1);
}

ConsolidationFit refused(Law law, std::string why) {
  ConsolidationFit fit;
  fit.law = law;
  fit.failure_reason = std::move(why);
  return fit;
}

/// Fits a consolidation law to points. With a robust loss function, recomputes the weights from the residuals and fits
/// again until the solution no longer changes.
std::optional<LawSolution> solve_robustly(Law law, LawPoints& points, Loss loss) {
  auto solution = solve_law(law, points);
  if (loss == Loss::squared || !solution) return solution;
  const Eigen::VectorXd given = points.weight;
  constexpr int kRounds = 100;
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::VectorXd before = solution->theta;
    const Eigen::VectorXd plain = solution->residuals.cwiseQuotient(points.weight).cwiseProduct(given);
    points.weight = given.cwiseProduct(loss_weights(loss, plain));
    solution = solve_law_from(law, points, before);
    if (!solution || (solution->theta - before).norm() <= 1e-9 * before.norm()) break;
  }
  return solution;
}

void describe_window(const ConsolidationCurve& curve, const Window& window, ConsolidationFit& fit) {
  fit.n_plateau = window.n_plateau;
  if (window.n_plateau > 0) {
    const int first = window.first_of_plateau();
    fit.plateau_low = curve.P_star[first];
    fit.plateau_high = curve.P_star[first + window.n_plateau - 1];
  }
  for (int i = 0; i < window.n; ++i) fit.used.push_back(window.first + i);
  fit.window_low = curve.P_star[window.first];
  fit.window_high = curve.P_star[window.first + window.n - 1];
}

/// Adds the uncertainty of the ends of the regimes to the covariance of the coordinates of a fit. The law is fitted
/// again with each of the less probable ends of a regime. The squared change of the coordinates is added, weighted by
/// the probability of this end.
void add_spread_over_places(const LawEstimate& e, const LawPoints& all, const Window& window,
                            const Regimes& regimes, Covariance& covariance) {
  struct Other {
    int first, end;
    double probability;
  };
  std::vector<Other> others;
  const int end = window.first + window.n;
  // If samples collapse in jumps, their scatter already contains the uncertainty of the end of the plateau. This end is
  // therefore not varied.
  const bool of_jumps = regimes.jump_distance > 0.0 && e.law == Law::log;
  if (e.law != Law::power && regimes.plateau_end && !of_jumps)
    for (const ChangePlace& p : regimes.plateau_end->places) others.push_back({p.first, end, p.probability});
  if (e.law != Law::full && regimes.onset_three)
    for (const ChangePlace& p : regimes.onset_three->places)
      others.push_back(e.law == Law::log ? Other{window.first, p.first, p.probability}
                                         : Other{p.first, end, p.probability});
  for (const Other& o : others) {
    if ((o.first == window.first && o.end == end) || o.end - o.first <= n_parameters(e.law)) continue;
    const auto solution = solve_law_from(e.law, all.range(o.first, o.end - o.first), e.solution.theta);
    if (!solution || !keeps_regime_two(e.law, all.range(o.first, o.end - o.first), *solution)) continue;
    Eigen::VectorXd change = Eigen::VectorXd::Zero(covariance.matrix.rows());
    change.head(e.solution.theta.size()) =
        at_first_pressure(e.law, solution->theta, all.log_P[window.first] - all.log_P[o.first]) -
        e.solution.theta;
    if (e.has_plateau() && o.first > 0) {
      const RecompressionLine line = recompression_line(all.range(0, o.first), e.line.slopes);
      change[e.solution.theta.size()] = line.at(e.line.centre) - e.line.level;
      if (line.slopes) change.tail(1)[0] = line.kappa - e.line.kappa;
    }
    covariance.matrix += o.probability * change * change.transpose();
  }
}

/// Returns the two parts of the standard error of each parameter: the part from the scatter of the data, and
/// the part from the uncertain ends of the regimes.
std::vector<ErrorParts> parts_of_errors(const LawEstimate& reported, const Covariance& scatter,
                                        const Covariance& all) {
  std::vector<ErrorParts> parts;
  for (const Quantity& quantity : quantities_of(reported)) {
    const auto own = fitted_parameter(quantity, scatter).standard_error;
    const auto total = fitted_parameter(quantity, all).standard_error;
    if (own && total)
      parts.push_back({quantity.name, *own, std::sqrt(std::max(*total * *total - *own * *own, 0.0))});
  }
  return parts;
}

/// Returns a fit that the points can identify: a fit of the line of regime II if `estimate` is a fit of the full law
/// but the points do not show the bend of this law, otherwise `estimate`.
LawEstimate identifiable_estimate(LawEstimate estimate) {
  if (estimate.law == Law::full && !detects_regime_three(estimate.points, estimate.solution) &&
      !detects_bend(estimate.points, estimate.solution)) {
    estimate.law = Law::log;
    estimate.solution = *solve_law(Law::log, estimate.points);
  }
  return estimate;
}

void describe_solution(const LawEstimate& reported, ConsolidationFit& fit) {
  const Eigen::VectorXd misfit = reported.solution.residuals.cwiseQuotient(reported.points.weight);
  fit.rms = std::sqrt(misfit.squaredNorm() / static_cast<double>(misfit.size()));
  fit.reported_law = reported.law;
  fit.theta = reported.solution.theta;
  fit.line = reported.line;
  fit.fitted = reported.points.y + misfit;
  fit.weights = reported.points.weight;
}

void add_bootstrap(const LawEstimate& reported, const Eigen::MatrixXd& samples,
                   const ConsolidationOptions& options, ConsolidationFit& fit) {
  if (options.n_bootstrap == 0) return;
  const Resampled resampled = resample(reported, samples, options.n_bootstrap, options.seed);
  fit.n_bootstrapped = resampled.n;
  fit.bootstrap = resampled.parameters;
  for (FittedParameter& p : fit.bootstrap) (void)keep_in_range(range_of(p.name, fit.phi_limit), p);
}

/// Fits a consolidation law to the points of a window, and adds the parameters, errors and warnings to `fit`.
ConsolidationFit fit_window(const ConsolidationCurve& curve, LawPoints all, const Window& window,
                            const ConsolidationOptions& options, ConsolidationFit fit) {
  const Law law = options.law;
  LawPoints points = all.range(window.first, window.n);
  auto solution = solve_robustly(law, points, options.loss);
  if (!solution) return refused(law, "the solid fraction does not grow with pressure in the window fitted");
  all.weight.segment(window.first, window.n) = points.weight;
  const int n_plateau = options.hold_P0 ? 0 : window.n_plateau;
  const LawPoints plateau = all.range(n_plateau > 0 ? window.first_of_plateau() : window.first, n_plateau);
  const LawEstimate estimate{law, points, *solution, plateau,
                             recompression_line(plateau, options.regimes.has_value())};
  const bool ends_early = law == Law::full && !detects_regime_three(points, estimate.solution);
  if (!ends_early && !keeps_regime_two(law, points, estimate.solution))
    return refused(law, fmt::format("only {} of the pressures lie below P1* = {:.4g}, where regime III begins, "
                                    "but regime II needs {}: try --law power",
                                    n_before_regime_three(points, estimate.solution),
                                    std::exp(estimate.solution.theta[3]), kMinInRegimeTwo));
  const LawEstimate reported = identifiable_estimate(estimate);
  describe_window(curve, window, fit);
  describe_solution(reported, fit);

  Eigen::MatrixXd samples;
  if (curve.samples.cols() >= 2) {
    samples.resize(n_plateau + window.n, curve.samples.cols());
    if (n_plateau > 0)
      samples.topRows(n_plateau) = curve.samples.middleRows(window.first_of_plateau(), n_plateau);
    samples.bottomRows(window.n) = curve.samples.middleRows(window.first, window.n);
  }
  fit.errors_from_samples = samples.cols() >= kMinForErrors;
  Covariance covariance = fit.errors_from_samples ? covariance_from_samples(reported, deviations_of(samples))
                                                  : covariance_from_residuals(reported);
  if (!fit.errors_from_samples) check_residuals(reported, fit);
  if (options.widen) covariance.matrix *= fit.pattern.variance_factor();
  const Covariance scatter = covariance;
  if (fit.regimes) add_spread_over_places(reported, all, window, *fit.regimes, covariance);
  fit.error_parts = parts_of_errors(reported, scatter, covariance);
  if (ends_early)
    bound_regime_three(reported, covariance, curve.phi[fit.used.back()], fit);
  else
    add_parameters(reported, covariance, curve.phi[fit.used.back()], fit);
  check_plateau(reported, fit);
  shift_window(reported, all, window, fit);
  add_bootstrap(reported, samples, options, fit);
  return fit;
}

}  // namespace

const FittedParameter* ConsolidationFit::find(const std::string& name) const {
  const auto found =
      std::find_if(parameters.begin(), parameters.end(), [&](const auto& p) { return p.name == name; });
  return found == parameters.end() ? nullptr : &*found;
}

std::vector<std::string> ConsolidationOptions::validate() const {
  std::vector<std::string> faults;
  if (n_bootstrap != 0) faults.push_back(range_fault("bootstrap", n_bootstrap, kBootstrap));
  if (window && !(window->first > 0.0 && window->first < window->second && std::isfinite(window->second)))
    faults.push_back(
        fmt::format("window = {},{}: the window must be two positive pressures P*, the lower one first",
                    window->first, window->second));
  if (!(phi_limit > 0.0))
    faults.push_back(fmt::format("phi_limit = {}: expected a positive solid fraction", phi_limit));
  std::erase(faults, "");
  return faults;
}

LawPoints law_points(const ConsolidationCurve& curve, Weighting weighting) {
  const auto n = static_cast<Eigen::Index>(curve.phi.size());
  const Eigen::VectorXd y = Eigen::Map<const Eigen::VectorXd>(curve.phi.data(), n).array().inverse();
  return {Eigen::Map<const Eigen::VectorXd>(curve.P_star.data(), n).array().log(), y,
          weights_of(curve, y, weighting)};
}

double ConsolidationFit::value(double log_P) const {
  return law_value(reported_law, theta, log_P, std::log(window_low));
}

ConsolidationFit fit_consolidation(const ConsolidationCurve& curve, const ConsolidationOptions& options) {
  assert(curve.P_star.size() == curve.phi.size());
  refuse_faults(options.validate());
  const Law law = options.law;
  const auto n = static_cast<int>(curve.phi.size());
  ConsolidationFit fit;
  fit.law = law;
  fit.phi_limit = options.phi_limit;
  fit.weighting = weighting_of(curve, options);
  if (n <= n_parameters(law)) return refused(law, too_few(law, n));
  LawPoints points = law_points(curve, fit.weighting);
  points.least_limit = 1.0 / options.phi_limit;
  // The search for the regimes does not use weights from the scatter of the samples, because the deviations of a sample
  // at neighbouring pressures are correlated.
  const Weighting of_shape = fit.weighting == Weighting::scatter ? Weighting::relative : fit.weighting;
  Window window{};
  if (options.window) {
    window = given_window(curve, *options.window);
  } else {
    fit.regimes = options.regimes ? options.regimes : find_regimes(law_points(curve, of_shape));
    if (fit.regimes && fit.regimes->all_in_one)
      return refused(law,
                     "all pressures lie in regime I: the solid fraction is constant or changes only "
                     "elastically, so that there is no line to fit");
    if (!fit.regimes)
      return refused(law, fmt::format("there is no range of at least {} pressures in which the solid fraction "
                                      "grows as in regime II: try --law log with --window lo,hi",
                                      kMinInRegimeTwo));
    window = window_of(law, *fit.regimes, n);
  }
  if (window.n <= n_parameters(law)) return refused(law, too_few(law, window.n));
  return fit_window(curve, points, window, options, std::move(fit));
}

}  // namespace floc
