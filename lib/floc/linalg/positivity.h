#pragma once

#include <Eigen/Core>
#include <functional>

namespace floc {

struct PositivityOptions {
  /// The test continues until it would have found any eigenvalue below minus this.
  double bound = 1e-4;
  int max_steps = 10000;
  /// Probability of missing an eigenvalue below -bound: the start vector is drawn at random, and may be normal
  /// to its eigenvector.
  double oversight = 1e-6;
  /// Eigenvalues above minus this count as zero: mechanisms, whose eigenvalues rounding changes.
  double rounding = 1e-10;
};

/// Result of a test of the lowest eigenvalue of a symmetric matrix A.
struct Positivity {
  bool negative = false;  ///< whether an eigenvalue is below zero: a direction of negative curvature was found
  /// If not `negative`: no eigenvalue is below -bound, up to the probability of an oversight.
  double bound = 0.0;
  int steps = 0;  ///< number of products with A
};

/// Tests the sign of the lowest eigenvalue by Lanczos' method from a random vector, without a factor: only
/// three vectors are held. A negative pivot of the growing tridiagonal matrix is a Rayleigh quotient below zero
/// and therefore certain. Without one, [KW1992] bounds the eigenvalue that k steps may have missed:
///
///   lowest eigenvalue > -e * (spread of the spectrum),  e = (ln(1.648 sqrt(n)/oversight)/(2 k - 1))^2
///
/// @param n      order of A
/// @param apply  A times a vector; A should have a diagonal of order one
[[nodiscard]] Positivity test_positivity(Eigen::Index n,
                                         const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& apply,
                                         const PositivityOptions& options);

/// Number of products after which test_positivity() of a matrix of this order and largest eigenvalue ends, if
/// it finds nothing.
int predicted_steps(Eigen::Index n, double largest_eigenvalue, const PositivityOptions& options);

}  // namespace floc
