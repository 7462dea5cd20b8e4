#pragma once

#include <Eigen/Core>
#include <functional>

namespace floc {

struct PositivityOptions {
  /// Tolerance of the test: it continues until it would have found any eigenvalue below -bound.
  double bound = 1e-4;
  int max_steps = 10000;
  /// Probability of missing an eigenvalue below -bound: the start vector is random and may be nearly orthogonal to the
  /// eigenvector.
  double oversight = 1e-6;
  /// Rounding error of eigenvalues: an eigenvalue above -rounding counts as zero, as for mechanisms.
  double rounding = 1e-10;
};

/// Result of a test of the lowest eigenvalue of a symmetric matrix A.
struct Positivity {
  bool negative = false;  ///< whether an eigenvalue is negative (a direction of negative curvature was found)
  /// If not `negative`: no eigenvalue is below -bound, except with the probability of an oversight.
  double bound = 0.0;
  int steps = 0;  ///< number of products with A
};

/// Tests the sign of the lowest eigenvalue of a symmetric matrix A by Lanczos' method from a random vector, without a
/// factor; only three vectors are stored. If a pivot of the growing tridiagonal matrix is negative, A certainly has a
/// negative eigenvalue, because a Rayleigh quotient is negative. Otherwise [KW1992] bounds the eigenvalue that k steps
/// may have missed:
///
///   lowest eigenvalue > -e * (spread of the spectrum),  e = (ln(1.648 sqrt(n)/oversight)/(2 k - 1))^2
///
/// @param n      order of A
/// @param apply  returns A times a vector; A should have a diagonal of order one
[[nodiscard]] Positivity test_positivity(Eigen::Index n,
                                         const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& apply,
                                         const PositivityOptions& options);

/// Returns the predicted number of products after which test_positivity() ends if it finds no negative eigenvalue, for
/// a matrix of order n with the given largest eigenvalue.
int predicted_steps(Eigen::Index n, double largest_eigenvalue, const PositivityOptions& options);

}  // namespace floc
