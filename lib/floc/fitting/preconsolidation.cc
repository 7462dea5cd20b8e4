#include "floc/fitting/preconsolidation.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "floc/fitting/least_squares.h"
#include "floc/fitting/line_fit.h"
#include "floc/fitting/round_bend.h"
#include "floc/fitting/student_t.h"
#include "floc/fitting/yield_constructions.h"

namespace floc {
namespace {

/// Returns the correlation of neighbouring residuals; 0 if independent residuals could have this correlation by chance,
/// or if the residuals are only rounding. Residuals are correlated, for example, if a sharp bend is fitted to a round
/// bend.
double correlation_of_neighbours(const Eigen::VectorXd& residuals) {
  constexpr double kRounding = 1e-9;
  const Eigen::Index n = residuals.size();
  const double squares = residuals.squaredNorm();
  if (squares < static_cast<double>(n) * kRounding * kRounding) return 0.0;
  const double correlation = residuals.head(n - 1).dot(residuals.tail(n - 1)) / squares;
  return correlation < 2.0 / std::sqrt(static_cast<double>(n)) ? 0.0 : correlation;
}

/// Returns the range of positions of the bend at which the sum of squares is at most `within`. The sum of squares is
/// interpolated linearly between the grid points of fit.profile, and as a parabola between the best position and the
/// next grid point on each side.
std::pair<double, double> places_within(const RoundBendFit& fit, double within) {
  const Eigen::VectorXd& left = fit.profile;
  double low = fit.best.bend, high = fit.best.bend;
  for (Eigen::Index k = 0; k < left.size(); ++k)
    if (left[k] <= within) low = std::min(low, fit.places[k]), high = std::max(high, fit.places[k]);
  const auto crossing = [&](Eigen::Index inside, Eigen::Index outside) {
    const double share = (within - left[inside]) / (left[outside] - left[inside]);
    return fit.places[inside] + share * (fit.places[outside] - fit.places[inside]);
  };
  for (Eigen::Index k = 0; k + 1 < left.size(); ++k) {
    if (left[k] > within && left[k + 1] <= within && fit.places[k + 1] <= low) low = crossing(k + 1, k);
    if (left[k] <= within && left[k + 1] > within && fit.places[k] >= high) high = crossing(k, k + 1);
  }
  // If the range is so narrow that it contains no grid point on one side, it ends between the best position and the
  // next grid point on this side.
  const double best = fit.best.bend, least = fit.best.sum_of_squares;
  const auto end_towards = [&](Eigen::Index outside) {
    return best + std::sqrt((within - least) / (left[outside] - least)) * (fit.places[outside] - best);
  };
  const auto first_above = std::upper_bound(fit.places.begin(), fit.places.end(), best) - fit.places.begin();
  const auto first_at = std::lower_bound(fit.places.begin(), fit.places.end(), best) - fit.places.begin();
  if (low == best && first_at > 0) low = end_towards(first_at - 1);
  if (high == best && first_above < fit.places.size()) high = end_towards(first_above);
  return {low, high};
}

PreconsolidationFit refused(std::string why) {
  PreconsolidationFit fit;
  fit.failure_reason = std::move(why);
  return fit;
}

}  // namespace

PreconsolidationFit fit_preconsolidation(const std::vector<double>& P, const std::vector<double>& phi) {
  assert(P.size() == phi.size());
  constexpr int kMinPressures = 5;  // one more than a sharp bend has parameters (P_c, y_c, kappa and lambda)
  // with fewer pressures a round bend cannot be distinguished from a sharp bend
  constexpr int kEnoughForWidth = 10;
  constexpr int kEnoughForConstructions = 8;
  const auto n = static_cast<Eigen::Index>(P.size());
  if (n < kMinPressures)
    return refused(
        fmt::format("there are {} pressures on this branch and beyond it, but the fit needs at least {}", n,
                    kMinPressures));
  const Eigen::ArrayXd x = Eigen::Map<const Eigen::ArrayXd>(P.data(), n).log();
  const Eigen::VectorXd y = Eigen::Map<const Eigen::ArrayXd>(phi.data(), n).inverse();
  const bool is_round = n >= kEnoughForWidth;
  const RoundBendFit lines = fit_round_bend(x, y, is_round);
  const RoundBend& best = lines.best;
  const double kappa = -best.slope_below, lambda = -best.slope_above;
  const auto dof = static_cast<int>(n) - (is_round ? 5 : 4);
  const double t95 = student_t_95(dof);
  const double variance = best.sum_of_squares / dof;
  const double allowed = best.sum_of_squares + t95 * t95 * variance;

  Eigen::MatrixXd straight(n, 2);
  straight << Eigen::VectorXd::Ones(n), x.matrix();
  if (lambda <= kappa || fit_linear(straight, y).sum_of_squares <= allowed)
    return refused(
        "the branch does not bend towards a steeper line: it does not reach the preconsolidation pressure");
  PreconsolidationFit fit;
  // Upper limit of the correlation of neighbouring residuals. Correlated residuals count as a smaller number of
  // independent residuals. At a correlation of 1, this number would be zero.
  constexpr double kMostCorrelated = 0.9;
  const double r = correlation_of_neighbours(lines.residuals);
  const double fewer = (1.0 + r) / (1.0 - std::min(r, kMostCorrelated));
  const double within = best.sum_of_squares + fewer * t95 * t95 * variance;
  if (r > 0.0)
    fit.warnings.push_back(
        fmt::format("neighbouring residuals are correlated (coefficient {:.2f}), because the bend is round or "
                    "the curve advances in jumps: the interval of P_c is widened to allow for this correlation",
                    r));
  const Eigen::Index last = lines.places.size() - 1;
  const auto [low, high] = places_within(lines, within);
  FittedParameter P_c{"P_c", std::exp(best.bend), std::nullopt, std::exp(low), std::exp(high), true};
  P_c.standard_error = (*P_c.high95 - *P_c.low95) / (2 * t95);
  const bool is_open_below = low <= lines.places[0], is_open_above = high >= lines.places[last];
  if (is_open_below || is_open_above) {
    P_c.identified = false;
    if (is_open_below) P_c.low95 = std::nullopt;
    if (is_open_above) P_c.high95 = std::nullopt;
    fit.warnings.push_back(
        "the preconsolidation pressure may lie at an end of the branch, so its 95 % interval is open at this "
        "end");
  }
  const Eigen::MatrixXd c = fewer * variance * unit_covariance(lines.jacobian);
  fit.parameters = {P_c, from_value("kappa", kappa, std::sqrt(c(1, 1)), t95),
                    from_value("lambda", lambda, std::sqrt(c(2, 2)), t95)};
  for (FittedParameter& p : fit.parameters) {
    const std::string beyond = keep_in_range({0.0, std::numeric_limits<double>::infinity()}, p);
    if (!beyond.empty()) fit.warnings.push_back(beyond);
  }
  if (n >= kEnoughForConstructions) {
    const YieldConstructions constructions = yield_constructions(P, y, best);
    std::vector<FittedParameter> methods = constructions.parameters;
    fit.parameters.insert(fit.parameters.end(), methods.begin(), methods.end());
    methods.push_back(P_c);
    fit.parameters.push_back(agreed_pressure(methods));
    fit.warnings.insert(fit.warnings.end(), constructions.warnings.begin(), constructions.warnings.end());
    if (!fit.parameters.back().value)
      fit.warnings.emplace_back(
          "the methods do not agree on a preconsolidation pressure: no pressure lies in all of their "
          "intervals");
  }
  fit.rms = std::sqrt(best.sum_of_squares / static_cast<double>(n));
  return fit;
}

}  // namespace floc
