#pragma once

#include <Eigen/Core>
#include <optional>

#include "floc/fitting/consolidation.h"

namespace floc {

/// Least squares of one law on given points, in coordinates that keep every parameter in its range:
///   log    theta = (ln lambda, y1)                          y = y1 - lambda ln(P/P_first)
///   power  theta = (ln A, ln alpha, 1/Phi_max)              y = 1/Phi_max + A P^-alpha
///   full   theta = (ln lambda, ln alpha, 1/Phi_max, ln P1)  y = 1/Phi_max - lambda g(ln P - ln P1)
struct LawSolution {
  Eigen::VectorXd theta;
  Eigen::MatrixXd covariance;   ///< of theta, scaled by the residual variance; infinite where not determined
  double sum_of_squares = 0.0;  ///< of the residuals of y = 1/Phi
};

/// @param log_P  logarithms of the reduced pressures  @param y  1/Phi; both of the same length
/// Absent when no start has a positive lambda (A): the density does not grow with pressure.
/// @pre more points than parameters.
[[nodiscard]] std::optional<LawSolution> solve_law(ConsolidationLaw law, const Eigen::VectorXd& log_P,
                                                   const Eigen::VectorXd& y);

/// Number of parameters of a law.
int n_parameters(ConsolidationLaw law);

}  // namespace floc
