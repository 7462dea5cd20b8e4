#pragma once

#include <Eigen/Core>
#include <optional>

namespace floc {

/// Consolidation law to fit (docs/physics.md, "Consolidation laws"; all in 1/Phi).
enum class ConsolidationLaw {
  log,    ///< regime II: 1/Phi = 1/Phi0 - lambda ln(P*/P0*)
  power,  ///< regime III: 1/Phi = 1/Phi_max + A (P*)^-alpha
  full,   ///< both: Eq. 9 of [GRC2008]
};

/// Returns the number of parameters of a law.
int n_parameters(ConsolidationLaw law);

/// Points of a curve as the laws are fitted to them, in the order of growing pressure; all of one length.
struct LawPoints {
  Eigen::VectorXd log_P;   ///< ln P*
  Eigen::VectorXd y;       ///< 1/Phi
  Eigen::VectorXd weight;  ///< residuals are multiplied by it; of order one, > 0

  int size() const { return static_cast<int>(y.size()); }
  LawPoints range(int first, int n) const {
    return {log_P.segment(first, n), y.segment(first, n), weight.segment(first, n)};
  }
};

/// Least squares of one law on given points, in coordinates that keep every parameter in its range:
///   log    theta = (ln lambda, y1)                          y = y1 - lambda ln(P/P_first)
///   power  theta = (ln A1, ln alpha, 1/Phi_max)             y = 1/Phi_max + A1 (P/P_first)^-alpha
///   full   theta = (ln lambda, ln alpha, 1/Phi_max, ln P1)  y = 1/Phi_max - lambda g(ln P - ln P1)
struct LawSolution {
  Eigen::VectorXd theta;
  Eigen::VectorXd residuals;    ///< weighted, model minus data
  Eigen::MatrixXd jacobian;     ///< derivatives of the weighted residuals; empty if a coordinate was held
  double sum_of_squares = 0.0;  ///< sum of squares of the weighted residuals
};

/// Returns 1/Phi of a law at ln P; `log_P_first` is ln P of the first point that the law was solved on.
double law_value(ConsolidationLaw law, const Eigen::VectorXd& theta, double log_P, double log_P_first);

/// Fits a law. Starts are found by linear projection on a grid of the nonlinear parameters; the best few are
/// followed to their minimum, and the best of these is refined to rounding by Levenberg-Marquardt (Ceres). The
/// solution is absent if no start has a positive lambda (A), that is, if the density does not grow with
/// pressure.
/// @pre more points than parameters.
[[nodiscard]] std::optional<LawSolution> solve_law(ConsolidationLaw law, const LawPoints& points);

/// Refines one start.
/// @param held  index of a coordinate of theta to keep; -1 for none
[[nodiscard]] std::optional<LawSolution> solve_law_from(ConsolidationLaw law, const LawPoints& points,
                                                        const Eigen::VectorXd& start, int held = -1);

// The functions below serve searches: they are fast, and accurate to about half the digits.

/// Returns the best end of the `n_tried` best starts; absent under the conditions of solve_law().
[[nodiscard]] std::optional<Eigen::VectorXd> start_of_law(ConsolidationLaw law, const LawPoints& points,
                                                          int n_tried);

/// Moves theta to the nearest minimum. @return the sum of squares there
double minimize_law(ConsolidationLaw law, const LawPoints& points, Eigen::VectorXd& theta);

/// Return the sum of squares left by the line of regime II, or by the power law, from its linear projection
/// alone; absent if the density does not grow with pressure.
[[nodiscard]] std::optional<double> residual_of_line(const LawPoints& points);
[[nodiscard]] std::optional<double> residual_of_power_law(const LawPoints& points);

}  // namespace floc
