#pragma once

#include <Eigen/Core>
#include <functional>

namespace floc {

struct PositivityOptions {
  /// The test ends when the steps suffice to find any eigenvalue below -bound.
  double bound = 1e-4;
  int max_steps = 10000;
  /// Accepted probability that the test misses an eigenvalue below -bound. The test misses it if the random start
  /// vector is nearly orthogonal to the eigenvector.
  double oversight = 1e-6;
  /// Rounding error of eigenvalues. An eigenvalue between -rounding and 0 counts as zero: it may be the eigenvalue of a
  /// mechanism.
  double rounding = 1e-10;
};

/// Result of a test whether the lowest eigenvalue of a symmetric matrix A is negative.
struct Positivity {
  /// whether A has a negative eigenvalue, because the test found a vector x with x^T A x < 0
  bool negative = false;
  /// If not `negative`: no eigenvalue of A is below -bound. The probability that this statement is wrong is
  /// PositivityOptions::oversight.
  double bound = 0.0;
  int steps = 0;  ///< number of products with A
};

/// Tests whether a symmetric matrix A has a negative eigenvalue, by Lanczos' method from a random start vector. No
/// factor of A is needed, and only three vectors are stored. The method builds a tridiagonal matrix, one row per step.
/// If a pivot of this matrix is negative, a Rayleigh quotient of A is negative, and A has a negative eigenvalue. If no
/// pivot is negative after k steps, the bound of [KW1992] holds, where n is the order of A. The bound is wrong with the
/// probability `options.oversight`:
///
///   lowest eigenvalue > -e * (largest minus lowest eigenvalue),  e = (ln(1.648 sqrt(n)/oversight)/(2 k - 1))^2
///
/// @param n      order of A
/// @param apply  function that returns the product of A with a vector; the diagonal of A should be of order one
[[nodiscard]] Positivity test_positivity(Eigen::Index n,
                                         const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& apply,
                                         const PositivityOptions& options);

/// Predicts the number of products with the matrix that test_positivity() makes if it finds no negative eigenvalue.
/// @param n                   order of the matrix
/// @param largest_eigenvalue  largest eigenvalue of the matrix
int predicted_steps(Eigen::Index n, double largest_eigenvalue, const PositivityOptions& options);

}  // namespace floc
