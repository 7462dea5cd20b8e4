#include "floc/fitting/preconsolidation.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "floc/fitting/line_fit.h"
#include "floc/fitting/student_t.h"

namespace floc {
namespace {

Eigen::MatrixXd columns_of_lines(const Eigen::ArrayXd& x, double bend) {
  Eigen::MatrixXd columns(x.size(), 3);
  columns.col(0).setOnes();
  columns.col(1) = x - bend;
  columns.col(2) = (x - bend).max(0.0);
  return columns;
}

/// Fits to y = 1/Phi, as a function of x = ln P, two lines that meet at x = `bend`: y_c - kappa (x - bend) below the
/// bend, and y_c - lambda (x - bend) above. The coefficients of the fit are y_c, -kappa and kappa - lambda.
LinearFit broken_line(const Eigen::ArrayXd& x, const Eigen::VectorXd& y, double bend) {
  return fit_linear(columns_of_lines(x, bend), y);
}

/// Returns the correlation of neighbouring residuals. Returns 0 if independent residuals could have it by chance, or if
/// the residuals are only rounding. A round bend leaves correlated residuals.
double correlation_of_neighbours(const Eigen::VectorXd& residuals) {
  constexpr double kRounding = 1e-9;
  const Eigen::Index n = residuals.size();
  const double squares = residuals.squaredNorm();
  if (squares < static_cast<double>(n) * kRounding * kRounding) return 0.0;
  const double correlation = residuals.head(n - 1).dot(residuals.tail(n - 1)) / squares;
  return correlation < 2.0 / std::sqrt(static_cast<double>(n)) ? 0.0 : correlation;
}

/// Sum of squared residuals of two lines that meet at a bend, as a function of the place of the bend. It is computed on
/// a fine grid of places, because it may have several minima.
struct BendProfile {
  static constexpr int kSteps = 4000;
  Eigen::VectorXd bend, left;
  Eigen::Index best = 0;

  BendProfile(const Eigen::ArrayXd& x, const Eigen::VectorXd& y)
      : bend(Eigen::VectorXd::LinSpaced(kSteps + 1, x[1], x[x.size() - 2])),
        left(bend.unaryExpr([&](double b) { return broken_line(x, y, b).sum_of_squares; })) {
    left.minCoeff(&best);
  }
};

PreconsolidationFit refused(std::string why) {
  PreconsolidationFit fit;
  fit.failure_reason = std::move(why);
  return fit;
}

}  // namespace

PreconsolidationFit fit_preconsolidation(const std::vector<double>& P, const std::vector<double>& phi) {
  assert(P.size() == phi.size());
  constexpr int kMinPressures = 5;  // one more than the number of parameters fitted: P_c, y_c, kappa and lambda
  const auto n = static_cast<Eigen::Index>(P.size());
  if (n < kMinPressures)
    return refused(fmt::format(
        "there are {} pressures on the reloading branch and beyond it, but the fit needs at least {}", n,
        kMinPressures));
  const Eigen::ArrayXd x = Eigen::Map<const Eigen::ArrayXd>(P.data(), n).log();
  const Eigen::VectorXd y = Eigen::Map<const Eigen::ArrayXd>(phi.data(), n).inverse();
  const BendProfile profile(x, y);
  const double bend = profile.bend[profile.best];
  const LinearFit lines = broken_line(x, y, bend);
  const double kappa = -lines.coefficients[1];
  const double lambda = kappa - lines.coefficients[2];
  const auto dof = static_cast<int>(n) - 4;
  const double t95 = student_t_95(dof);
  const double variance = lines.sum_of_squares / dof;
  const double allowed = lines.sum_of_squares + t95 * t95 * variance;

  Eigen::MatrixXd straight(n, 2);
  straight << Eigen::VectorXd::Ones(n), x.matrix();
  if (lambda <= kappa || fit_linear(straight, y).sum_of_squares <= allowed)
    return refused(
        "the reloading branch does not bend towards a steeper line: it does not reach the preconsolidation "
        "pressure");
  PreconsolidationFit fit;
  // Largest correlation of neighbouring residuals that is taken into account. Correlated residuals count as a smaller
  // number of independent residuals, which would be zero at a correlation of 1.
  constexpr double kMostCorrelated = 0.9;
  const double r = correlation_of_neighbours(y - columns_of_lines(x, bend) * lines.coefficients);
  const double fewer = (1.0 + r) / (1.0 - std::min(r, kMostCorrelated));
  const double within = lines.sum_of_squares + fewer * t95 * t95 * variance;
  if (r > 0.0)
    fit.warnings.push_back(fmt::format(
        "neighbouring residuals are correlated (coefficient {:.2f}), because the bend is round or the curve "
        "moves in steps: the interval of P_c is widened to allow for this",
        r));
  Eigen::Index low = profile.best, high = profile.best;
  for (Eigen::Index k = 0; k < profile.left.size(); ++k)
    if (profile.left[k] <= within) low = std::min(low, k), high = std::max(high, k);
  FittedParameter P_c{
      "P_c", std::exp(bend), std::nullopt, std::exp(profile.bend[low]), std::exp(profile.bend[high]), true};
  P_c.standard_error = (*P_c.high95 - *P_c.low95) / (2 * t95);
  if (low == 0 || high == profile.left.size() - 1) {
    P_c.identified = false;
    if (low == 0) P_c.low95 = std::nullopt;
    if (high == profile.left.size() - 1) P_c.high95 = std::nullopt;
    fit.warnings.push_back(
        "the preconsolidation pressure may lie at an end of the branch: its interval is open there");
  }
  // The place of the bend was fitted too, which takes one degree of freedom from the residual variance of the
  // lines.
  const Eigen::MatrixXd c = lines.covariance * (static_cast<double>(lines.dof) / dof);
  fit.parameters = {P_c, from_value("kappa", kappa, std::sqrt(c(1, 1)), t95),
                    from_value("lambda", lambda, std::sqrt(c(1, 1) + c(2, 2) + 2 * c(1, 2)), t95)};
  for (FittedParameter& p : fit.parameters) {
    const std::string beyond = keep_in_range({0.0, std::numeric_limits<double>::infinity()}, p);
    if (!beyond.empty()) fit.warnings.push_back(beyond);
  }
  fit.rms = std::sqrt(lines.sum_of_squares / static_cast<double>(n));
  return fit;
}

}  // namespace floc
