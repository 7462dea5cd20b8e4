#pragma once

#include <Eigen/Core>

namespace floc {

/// Solution of a linear least-squares problem, with the covariance of its coefficients.
struct LinearFit {
  Eigen::VectorXd coefficients;
  /// Covariance of the coefficients, scaled by the residual variance; zero if dof is 0.
  Eigen::MatrixXd covariance;
  double sum_of_squares = 0.0;
  int dof = 0;  ///< degrees of freedom: number of points minus number of coefficients
};

/// Fits y by a linear combination of the columns of a matrix (least squares).
/// @param columns  matrix of points x coefficients, of full rank, with at least as many points as coefficients
[[nodiscard]] LinearFit fit_linear(const Eigen::MatrixXd& columns, const Eigen::VectorXd& y);

}  // namespace floc
