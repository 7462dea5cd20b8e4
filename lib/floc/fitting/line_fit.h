#pragma once

#include <Eigen/Core>

namespace floc {

/// Solution of a linear least-squares problem, with the covariance of its coefficients.
struct LinearFit {
  Eigen::VectorXd coefficients;
  /// Covariance of the coefficients, from the residual variance; zero if dof is 0.
  Eigen::MatrixXd covariance;
  double sum_of_squares = 0.0;
  int dof = 0;  ///< degrees of freedom: number of points minus number of coefficients
};

/// Fits y by a linear combination of the columns of a matrix (least squares).
/// @param columns  matrix of points x coefficients, of full rank, with at least as many points as coefficients
[[nodiscard]] LinearFit fit_linear(const Eigen::MatrixXd& columns, const Eigen::VectorXd& y);

/// Straight line y = intercept + slope * x, and the sum of its squared weighted residuals.
struct WeightedLine {
  double intercept, slope, sum_of_squares;

  double at(double x) const { return intercept + slope * x; }
};

/// Fits a straight line by weighted least squares. The slope is zero if all x are equal.
/// @param weight  factor by which the residual of each point is multiplied
[[nodiscard]] WeightedLine fit_weighted_line(const Eigen::VectorXd& x, const Eigen::VectorXd& y,
                                             const Eigen::VectorXd& weight);

}  // namespace floc
