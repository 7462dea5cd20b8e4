#include "floc/fitting/window_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floc/fitting/line_fit.h"

namespace floc {
namespace {

using Law = ConsolidationLaw;

/// Returns the weighted residuals of all fitted points: first of the recompression line, then of the law.
Eigen::VectorXd all_residuals(const LawEstimate& e) {
  const LawPoints& p = e.plateau;
  Eigen::VectorXd residuals(p.size() + e.points.size());
  for (int i = 0; i < p.size(); ++i) residuals[i] = p.weight[i] * (e.line.at(p.log_P[i]) - p.y[i]);
  residuals.tail(e.points.size()) = e.solution.residuals;
  return residuals;
}

/// Returns a basis of the columns of the Jacobian of all_residuals(). The recompression line and the law have no
/// common parameters.
Eigen::MatrixXd basis_of_all(const LawEstimate& e) {
  const Eigen::Index n_plateau = e.plateau.size(), n = e.points.size();
  Eigen::MatrixXd of_line(n_plateau, 0);
  if (n_plateau > 0) {
    Eigen::MatrixXd columns(n_plateau, e.line.slopes ? 2 : 1);
    columns.col(0) = e.plateau.weight;
    if (e.line.slopes) columns.col(1) = e.plateau.weight.cwiseProduct(e.plateau.log_P);
    of_line = basis_of(columns);
  }
  const Eigen::MatrixXd of_law = basis_of(e.solution.jacobian);
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(n_plateau + n, of_line.cols() + of_law.cols());
  basis.topLeftCorner(n_plateau, of_line.cols()) = of_line;
  basis.bottomRightCorner(n, of_law.cols()) = of_law;
  return basis;
}

}  // namespace

void check_residuals(const LawEstimate& estimate, ConsolidationFit& fit) {
  fit.pattern = residual_pattern(all_residuals(estimate), basis_of_all(estimate));
  if (!fit.pattern.is_systematic()) return;
  fit.warnings.push_back(fmt::format(
      "the residuals follow a pattern (correlation of neighbours {:.2f}; for independent errors, the "
      "probability of such a pattern would be {:.1g}): the curve does not follow this law, or it advances in "
      "jumps, so that "
      "standard errors computed for independent residuals are too small; fit the mean of several samples, "
      "because the scatter between samples gives better errors",
      fit.pattern.correlation, std::min(fit.pattern.smoothness_p, fit.pattern.runs_p)));
}

void check_plateau(const LawEstimate& estimate, ConsolidationFit& fit) {
  // smallest slope of the plateau that causes a warning, as a fraction of lambda, the slope of regime II
  constexpr double kLevel = 0.1;
  constexpr double kSignificant = 3.0;
  const LawPoints& plateau = estimate.plateau;
  if (estimate.law == Law::power || plateau.size() < 3 || estimate.line.slopes) return;
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
  constexpr double kWorthSaying = 1e-3;  // smallest change that causes a warning, as a fraction of lambda
  for (const WindowShift& s : fit.window_shifts)
    if (!s.lambda ||
        std::abs(*s.lambda - *lambda->value) > std::max(*lambda->standard_error, kWorthSaying * *lambda->value))
      fit.warnings.push_back(fmt::format(
          "lambda depends on the window of pressures: {2:.4g} for the window fitted, but {0} for a window with "
          "its {1}",
          s.lambda ? fmt::format("{:.4g}", *s.lambda) : "no regime II is left", s.change, *lambda->value));
}

}  // namespace floc
