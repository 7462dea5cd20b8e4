#include "floc/fitting/consolidation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "floc/fitting/consolidation_bootstrap.h"
#include "floc/fitting/law_estimate.h"
#include "floc/fitting/line_fit.h"

namespace floc {
namespace {

using Law = ConsolidationLaw;

/// Smallest number of samples whose scatter gives the weights and the standard errors of the fit to their mean curve.
constexpr Eigen::Index kMinSamples = 3;

const char* name_of(Law law) {
  return law == Law::log ? "log" : law == Law::power ? "power" : "full";
}

const char* place_of(Law law) {
  return law == Law::log ? "regime II" : law == Law::power ? "regime III" : "the window";
}

Weighting weighting_of(const ConsolidationCurve& curve, const ConsolidationOptions& options) {
  if (options.weighting != Weighting::automatic) return options.weighting;
  return curve.samples.cols() >= kMinSamples ? Weighting::scatter : Weighting::relative;
}

/// Returns the deviation of each sample (columns) from the mean of the samples, at each point of the curve (rows).
Eigen::MatrixXd deviations_of(const Eigen::MatrixXd& samples) {
  return samples.colwise() - samples.rowwise().mean();
}

/// Returns the variance of 1/Phi between samples at each pressure. Because a few samples determine it badly, it is
/// averaged over five neighbouring pressures, and is raised to at least a tenth of the mean variance.
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

/// Returns the weight of the residual of each point of a curve, scaled so that the mean square of the weights is one.
Eigen::VectorXd weights_of(const ConsolidationCurve& curve, const Eigen::VectorXd& y, Weighting weighting) {
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(y.size());
  if (weighting == Weighting::relative) weights = y.cwiseInverse();
  if (weighting == Weighting::scatter) {
    const Eigen::VectorXd variance = smooth_variance(curve.samples);
    if (variance.mean() > 0.0) weights = variance.cwiseSqrt().cwiseInverse();
  }
  return weights / std::sqrt(weights.squaredNorm() / static_cast<double>(weights.size()));
}

LawPoints points_of(const ConsolidationCurve& curve, Weighting weighting) {
  const auto n = static_cast<Eigen::Index>(curve.phi.size());
  const Eigen::VectorXd y = Eigen::Map<const Eigen::VectorXd>(curve.phi.data(), n).array().inverse();
  return {Eigen::Map<const Eigen::VectorXd>(curve.P_star.data(), n).array().log(), y,
          weights_of(curve, y, weighting)};
}

/// Window of points to which a consolidation law is fitted: index of its first point, number of points, and
/// number of points of the plateau of regime I right before it.
struct Window {
  int first, n;
  int n_plateau;
};

Window given_window(const ConsolidationCurve& curve, std::pair<double, double> window) {
  // Relative tolerance of the bounds of the window, so that a bound that was typed with a few digits includes the point
  // whose pressure was rounded to it.
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
  if (law == Law::log) return {k, regimes.end_of_two - k, k};
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
  if (window.n_plateau > 0) fit.plateau_high = curve.P_star[window.first - 1];
  for (int i = 0; i < window.n; ++i) fit.used.push_back(window.first + i);
  fit.window_low = curve.P_star[window.first];
  fit.window_high = curve.P_star[window.first + window.n - 1];
}

/// Returns the correlation matrix of the first `n` parameters of a fit. The sign is reversed for a parameter of which
/// the inverse was fitted, such as Phi_max, because 1/Phi_max falls as Phi_max grows.
Eigen::MatrixXd correlation_of(const std::vector<Quantity>& quantities, Eigen::Index n,
                               const Eigen::MatrixXd& covariance) {
  Eigen::MatrixXd gradients(n, covariance.cols());
  for (Eigen::Index k = 0; k < n; ++k)
    gradients.row(k) = (quantities[k].is_inverse ? -1.0 : 1.0) * quantities[k].gradient;
  const Eigen::MatrixXd c = gradients * covariance * gradients.transpose();
  const Eigen::VectorXd scale = c.diagonal().cwiseSqrt().cwiseInverse();
  return scale.asDiagonal() * c * scale.asDiagonal();
}

/// Replaces the 95 % interval of a fitted parameter by the interval of the profile likelihood. An end of the
/// interval is absent if the data do not limit the parameter on that side.
void profile(const LawEstimate& estimate, int coordinate, const Covariance& covariance, bool is_inverse,
             FittedParameter& p, ConsolidationFit& fit) {
  const ProfileInterval c = profile_interval(estimate, coordinate, covariance);
  const auto parameter = [is_inverse](double at) { return is_inverse ? 1.0 / at : std::exp(at); };
  p.low95 = p.high95 = std::nullopt;
  const auto& low = is_inverse ? c.high : c.low;
  const auto& high = is_inverse ? c.low : c.high;
  if (low) p.low95 = parameter(*low);
  if (high) p.high95 = parameter(*high);
  constexpr double kIdentifiedFactor = 10.0;
  p.identified = p.low95 && p.high95 && *p.value < kIdentifiedFactor * *p.low95 &&
                 *p.high95 < kIdentifiedFactor * *p.value;
  fit.profiled.push_back(p.name);
}

std::string bounds_in_words(const FittedParameter& p) {
  if (p.low95 && p.high95) return fmt::format("between {:.4g} and {:.4g}", *p.low95, *p.high95);
  if (p.low95) return fmt::format("at least {:.4g}", *p.low95);
  if (p.high95) return fmt::format("at most {:.4g}", *p.high95);
  return "not bounded";
}

/// Returns the physical range of a parameter of a consolidation law: solid fractions lie between 0 and 1, other
/// parameters are not negative.
PhysicalRange range_of(const std::string& name) {
  const bool is_fraction = name == "Phi_max" || name == "Phi0";
  return {0.0, is_fraction ? 1.0 : std::numeric_limits<double>::infinity()};
}

/// Adds the parameters of a fitted consolidation law, their 95 % intervals and warnings about them to `fit`.
/// @param last_phi  solid fraction at the highest pressure fitted; lower bound of Phi_max if the fit gives no Phi_max
void add_parameters(const LawEstimate& estimate, const Covariance& covariance, double last_phi,
                    ConsolidationFit& fit) {
  const std::vector<Quantity> quantities = quantities_of(estimate);
  for (const Quantity& q : quantities) {
    fit.parameters.push_back(fitted_parameter(q, covariance));
    FittedParameter& p = fit.parameters.back();
    if (q.name == "alpha") profile(estimate, 1, covariance, false, p, fit);
    if (q.name == "Phi_max") profile(estimate, 2, covariance, true, p, fit);
    if (const std::string why = keep_in_range(range_of(p.name), p); !why.empty()) {
      if (p.name == "Phi_max") p.low95 = std::min(1.0, last_phi);
      fit.warnings.push_back(why);
      continue;
    }
    if (p.identified) continue;
    fit.warnings.push_back(fmt::format("{} is not identified by these data: its value is {} (95 % interval)",
                                       p.name, bounds_in_words(p)));
    p.value = p.standard_error = std::nullopt;
  }
  if (estimate.law != Law::power && !estimate.has_plateau())
    fit.parameters.push_back(held_at("P0_star", fit.window_low));
  const Eigen::Index n_free = estimate.solution.theta.size() - (estimate.law == Law::log ? 1 : 0);
  for (Eigen::Index k = 0; k < n_free; ++k) fit.correlated.push_back(quantities[k].name);
  fit.correlation = correlation_of(quantities, n_free, covariance.matrix);
}

/// Adds the parameters of a fit to data that end before P1*, the pressure at which regime III begins: the slope lambda
/// of regime II, and lower bounds of Phi_max and P1*.
void bound_regime_three(const LawEstimate& reported, const Covariance& covariance, double last_phi,
                        ConsolidationFit& fit) {
  const std::vector<Quantity> quantities = quantities_of(reported);
  fit.parameters.push_back(fitted_parameter(quantities.front(), covariance));
  fit.parameters.push_back(bounded_below("alpha", std::nullopt));
  fit.parameters.push_back(bounded_below("Phi_max", last_phi));
  fit.parameters.push_back(bounded_below("P1_star", fit.window_high));
  for (const Quantity& q : quantities)
    if (q.name == "Phi0" || q.name == "P0_star") {
      fit.parameters.push_back(fitted_parameter(q, covariance));
      const std::string beyond = keep_in_range(range_of(q.name), fit.parameters.back());
      if (!beyond.empty()) fit.warnings.push_back(beyond);
    }
  if (!reported.has_plateau()) fit.parameters.push_back(held_at("P0_star", fit.window_low));
  fit.correlated = {"lambda"};
  fit.correlation = Eigen::MatrixXd::Ones(1, 1);
  fit.warnings.push_back(
      fmt::format("the data end at P* = {:.6g}, before regime III begins at P1*: alpha is not identified, only "
                  "bounds of P1_star and Phi_max are given, and lambda is the slope of {}",
                  fit.window_high, reported.law == Law::full ? "the full law" : "the line of regime II"));
}

/// Warns if neighbouring residuals are correlated, which makes the standard errors from a single curve too
/// small.
void check_independence(const LawEstimate& estimate, ConsolidationFit& fit) {
  const Eigen::VectorXd& r = estimate.solution.residuals;
  const Eigen::Index n = r.size();
  const double correlation = r.head(n - 1).dot(r.tail(n - 1)) / r.squaredNorm();
  const bool is_rounding = fit.rms < 1e-9;
  if (is_rounding || correlation < 2.0 / std::sqrt(static_cast<double>(n))) return;
  fit.warnings.push_back(fmt::format(
      "neighbouring residuals are correlated (coefficient {:.2f}): the curve moves in steps, or does not "
      "follow this law, so that the standard errors are too small; fit the mean of several "
      "samples, whose scatter gives better errors",
      correlation));
}

/// Warns if the plateau of regime I is not level, as in the recompression of a soil. The fit takes for P0* the pressure
/// at which the line of regime II meets the mean level of the plateau. The warning gives the pressure at which it meets
/// a sloping line through the plateau.
void check_plateau(const LawEstimate& estimate, ConsolidationFit& fit) {
  // smallest slope of the plateau worth a warning, as a share of lambda, the slope of regime II
  constexpr double kLevel = 0.1;
  constexpr double kSignificant = 3.0;
  const LawPoints& plateau = estimate.plateau;
  if (estimate.law == Law::power || plateau.size() < 3) return;
  Eigen::MatrixXd columns(plateau.size(), 2);
  columns << Eigen::VectorXd::Ones(plateau.size()), -plateau.log_P;
  const LinearFit line = fit_linear(columns, plateau.y);
  const double slope = line.coefficients[1], lambda = std::exp(estimate.solution.theta[0]);
  if (!(slope > kLevel * lambda && slope < lambda)) return;
  if (slope < kSignificant * std::sqrt(line.covariance(1, 1))) return;
  const double first = std::log(fit.window_low);
  const double log_P =
      (law_value(estimate.law, estimate.solution.theta, first, first) + lambda * first - line.coefficients[0]) /
      (lambda - slope);
  fit.warnings.push_back(fmt::format(
      "the plateau of regime I is not level: 1/Phi falls by {:.2g} for each unit of ln P* there, "
      "which is {:.0f} % of lambda; lines through the plateau and through regime II meet at P* = {:.4g}",
      slope, 100.0 * slope / lambda, std::exp(log_P)));
}

/// Moves one end of the range of fitted points by one point and fits the law again, for both ends and both directions.
/// Warns if lambda, the slope of regime II, changes by more than its standard error.
void shift_window(const LawEstimate& estimate, const LawPoints& all, const Window& window,
                  ConsolidationFit& fit) {
  if (estimate.law == Law::power) return;
  struct Shift {
    const char* change;
    int first, last;
  };
  const std::vector<Shift> shifts = {{"first row earlier", -1, 0},
                                     {"first row later", 1, 0},
                                     {"last row earlier", 0, -1},
                                     {"last row later", 0, 1}};
  for (const Shift& s : shifts) {
    const int first = window.first + s.first;
    const int n = window.n - s.first + s.last;
    if (first < 0 || first + n > all.size() || n <= n_parameters(estimate.law)) continue;
    const LawPoints points = all.range(first, n);
    const auto solution = solve_law_from(estimate.law, points, estimate.solution.theta);
    if (!solution) continue;
    const bool has_two = keeps_regime_two(estimate.law, points, *solution);
    fit.window_shifts.push_back(
        {s.change, has_two ? std::optional(std::exp(solution->theta[0])) : std::nullopt});
  }
  const FittedParameter* lambda = fit.find("lambda");
  if (!lambda || !lambda->value || !lambda->standard_error) return;
  for (const WindowShift& s : fit.window_shifts)
    if (!s.lambda ||
        std::abs(*s.lambda - *lambda->value) > std::max(*lambda->standard_error, 1e-6 * *lambda->value))
      fit.warnings.push_back(fmt::format(
          "lambda depends on the window of pressures: {} for a window with the {}, {:.4g} for the window "
          "fitted",
          s.lambda ? fmt::format("{:.4g}", *s.lambda) : "no regime II is left", s.change, *lambda->value));
}

/// Adds the uncertainty of the ends of the regimes to the covariance of the coordinates theta of a fit. For every other
/// probable end of a regime, the law is fitted again to the points up to this end, and the squared change of theta is
/// added, weighted by the probability of this end.
void add_spread_over_places(const LawEstimate& e, const LawPoints& all, const Window& window,
                            const Regimes& regimes, Covariance& covariance) {
  struct Other {
    int first, end;
    double probability;
  };
  std::vector<Other> others;
  const int end = window.first + window.n;
  if (e.law != Law::power && regimes.plateau_end)
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
    if (e.has_plateau() && o.first > 0) change.tail(1)[0] = mean_level(all.range(0, o.first)) - e.plateau_level;
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

/// Returns the fit of the law that the points can identify: the line of regime II if `estimate` is the full law and the
/// points do not show its bend, otherwise `estimate`.
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
  fit.fitted = reported.points.y + misfit;
  fit.weights = reported.points.weight;
}

void add_bootstrap(const LawEstimate& reported, const Eigen::MatrixXd& samples,
                   const ConsolidationOptions& options, ConsolidationFit& fit) {
  if (options.n_bootstrap == 0) return;
  const Resampled resampled = resample(reported, samples, options.n_bootstrap, options.seed);
  fit.n_bootstrapped = resampled.n;
  fit.bootstrap = resampled.parameters;
  for (FittedParameter& p : fit.bootstrap) (void)keep_in_range(range_of(p.name), p);
}

/// Fits a consolidation law to the points of a window, and adds the parameters, errors and warnings to `fit`.
ConsolidationFit fit_window(const ConsolidationCurve& curve, LawPoints all, const Window& window,
                            const ConsolidationOptions& options, ConsolidationFit fit) {
  const Law law = options.law;
  LawPoints points = all.range(window.first, window.n);
  auto solution = solve_robustly(law, points, options.loss);
  if (!solution)
    return refused(law, "the solid fraction does not grow with pressure in the window that is fitted");
  all.weight.segment(window.first, window.n) = points.weight;
  const int n_plateau = options.hold_P0 ? 0 : window.n_plateau;
  const LawPoints plateau = all.range(window.first - n_plateau, n_plateau);
  const LawEstimate estimate{law, points, *solution, plateau, mean_level(plateau)};
  const bool ends_early = law == Law::full && !detects_regime_three(points, estimate.solution);
  if (!ends_early && !keeps_regime_two(law, points, estimate.solution))
    return refused(law, fmt::format("only {} of the pressures lie below P1* = {:.4g}, where regime III begins, "
                                    "but regime II needs {}: try --law power",
                                    n_before_regime_three(points, estimate.solution),
                                    std::exp(estimate.solution.theta[3]), kMinInRegimeTwo));
  const LawEstimate reported = identifiable_estimate(estimate);
  describe_window(curve, window, fit);
  describe_solution(reported, fit);

  const Eigen::MatrixXd samples =
      curve.samples.cols() >= 2
          ? Eigen::MatrixXd(curve.samples.middleRows(window.first - n_plateau, window.n + n_plateau))
          : Eigen::MatrixXd();
  fit.errors_from_samples = samples.cols() >= kMinSamples;
  Covariance covariance = fit.errors_from_samples ? covariance_from_samples(reported, deviations_of(samples))
                                                  : covariance_from_residuals(reported);
  const Covariance scatter = covariance;
  if (fit.regimes) add_spread_over_places(reported, all, window, *fit.regimes, covariance);
  fit.error_parts = parts_of_errors(reported, scatter, covariance);
  if (ends_early)
    bound_regime_three(reported, covariance, curve.phi[fit.used.back()], fit);
  else
    add_parameters(reported, covariance, curve.phi[fit.used.back()], fit);
  if (!fit.errors_from_samples) check_independence(reported, fit);
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
  std::erase(faults, "");
  return faults;
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
  fit.weighting = weighting_of(curve, options);
  if (n <= n_parameters(law)) return refused(law, too_few(law, n));
  const LawPoints points = points_of(curve, fit.weighting);
  // The search for the regimes uses weights that do not depend on the scatter of the samples, because this
  // scatter is correlated between neighbouring pressures.
  const Weighting of_shape = fit.weighting == Weighting::scatter ? Weighting::relative : fit.weighting;
  Window window{};
  if (options.window) {
    window = given_window(curve, *options.window);
  } else {
    fit.regimes = find_regimes(points_of(curve, of_shape));
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
