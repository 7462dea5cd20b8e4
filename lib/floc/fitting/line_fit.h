#pragma once

#include <Eigen/Core>

namespace floc {

/// Linear least squares with the errors of its coefficients.
struct LinearFit {
  Eigen::VectorXd coefficients;
  Eigen::MatrixXd covariance;  ///< scaled by the residual variance; zero without spare points
  double sum_of_squares = 0.0;
  int dof = 0;  ///< points less coefficients
};

/// Fits y by a linear combination of columns.
/// @param columns  points x coefficients, of full rank, at least as many points as coefficients
[[nodiscard]] LinearFit fit_linear(const Eigen::MatrixXd& columns, const Eigen::VectorXd& y);

}  // namespace floc
