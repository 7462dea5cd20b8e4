#pragma once

#include <Eigen/Core>
#include <optional>

namespace floc {

/// Consolidation law to fit, for the solid fraction Phi at the reduced pressure P* (docs/physics.md, "Consolidation
/// laws").
enum class ConsolidationLaw {
  log,    ///< regime II: 1/Phi = 1/Phi0 - lambda ln(P*/P0*)
  power,  ///< regime III: 1/Phi = 1/Phi_max + A (P*)^-alpha
  full,   ///< regimes II and III: Eq. 9 of [GRC2008]
};

/// Returns the number of parameters of a consolidation law.
int n_parameters(ConsolidationLaw law);

/// Points of a consolidation curve in the form that the fits use. The order is by growing pressure. All vectors have
/// one entry per point.
struct LawPoints {
  Eigen::VectorXd log_P;     ///< ln P*
  Eigen::VectorXd y;         ///< 1/Phi
  Eigen::VectorXd weight;    ///< factor by which the residual of each point is multiplied; of order one, > 0
  double least_limit = 0.0;  ///< smallest value that the limit 1/Phi_max of a law may have

  int size() const { return static_cast<int>(y.size()); }
  LawPoints range(int first, int n) const {
    return {log_P.segment(first, n), y.segment(first, n), weight.segment(first, n), least_limit};
  }
};

/// Least-squares fit of a consolidation law to given points. The parameters lambda, alpha, A1 and P1 are positive for
/// any theta, because theta contains their logarithms. Below, y is 1/Phi, P the reduced pressure, P_first the first
/// pressure fitted, y1 and A1 are the values of y and of y - 1/Phi_max at this pressure, and g is
/// consolidation_bracket():
///   log    theta = (ln lambda, y1)                          y = y1 - lambda ln(P/P_first)
///   power  theta = (ln A1, ln alpha, 1/Phi_max)             y = 1/Phi_max + A1 (P/P_first)^-alpha
///   full   theta = (ln lambda, ln alpha, 1/Phi_max, ln P1)  y = 1/Phi_max - lambda g(ln P - ln P1)
struct LawSolution {
  Eigen::VectorXd theta;
  Eigen::VectorXd residuals;  ///< weighted residuals of the points, law minus data
  /// Derivatives of the weighted residuals with respect to theta; empty if an entry of theta was held fixed.
  Eigen::MatrixXd jacobian;
  double sum_of_squares = 0.0;  ///< sum of squares of the weighted residuals
  /// True if 1/Phi_max is at its bound LawPoints::least_limit. Without this bound, the best 1/Phi_max would be smaller.
  bool at_limit = false;
};

/// Index of 1/Phi_max in theta, for the laws that have it.
inline constexpr int kLimitParameter = 2;

/// Returns the inverse solid fraction 1/Phi of a consolidation law at the reduced pressure exp(log_P).
/// @param log_P_first  ln P* of the first point to which the law was fitted
double law_value(ConsolidationLaw law, const Eigen::VectorXd& theta, double log_P, double log_P_first);

/// Fits a consolidation law:
/// 1. For each point of a grid of the nonlinear parameters, linear least squares give the linear parameters. The
/// nonlinear and the linear parameters together are a starting point.
/// 2. From the best few starting points, the solver descends to a minimum.
/// 3. The best minimum is refined by Levenberg-Marquardt (Ceres), until only rounding errors remain.
///
/// The solution is absent if no starting point gives a solid fraction that grows with pressure.
/// @pre There are more points than parameters.
[[nodiscard]] std::optional<LawSolution> solve_law(ConsolidationLaw law, const LawPoints& points);

/// Fits a consolidation law, exact to rounding.
/// @param start  starting point of theta
/// @param held  index of an entry of theta that is kept fixed; -1 to fit all
[[nodiscard]] std::optional<LawSolution> solve_law_from(ConsolidationLaw law, const LawPoints& points,
                                                        const Eigen::VectorXd& start, int held = -1);

// The functions below are meant for searches over many windows: they are fast, but only about half of the digits of a
// double are accurate.

/// Returns theta of a consolidation law at the best minimum that the solver reaches from the `n_tried` best starting
/// points. The result is absent if no starting point gives a solid fraction that grows with pressure.
[[nodiscard]] std::optional<Eigen::VectorXd> start_of_law(ConsolidationLaw law, const LawPoints& points,
                                                          int n_tried);

/// Moves theta to a nearby minimum of the sum of squared residuals of a consolidation law.
/// @return the sum of squares at the minimum
double minimize_law(ConsolidationLaw law, const LawPoints& points, Eigen::VectorXd& theta);

/// Both functions return the sum of squared residuals of a least-squares fit to 1/Phi: residual_of_line() fits a
/// straight line in ln P* (regime II), and residual_of_power_law() a power law of P* (regime III). The result is absent
/// if the solid fraction does not grow with pressure.
[[nodiscard]] std::optional<double> residual_of_line(const LawPoints& points);
[[nodiscard]] std::optional<double> residual_of_power_law(const LawPoints& points);

}  // namespace floc
