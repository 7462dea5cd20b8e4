#pragma once

#include <Eigen/Core>

namespace floc {

/// Result of two tests whether the residuals of a fit are noise or follow a pattern along the curve. A pattern appears
/// if the law does not describe the data, or if the measured curve advances in jumps.
struct ResidualPattern {
  double correlation = 0.0;  ///< correlation of neighbouring residuals
  /// Probability that independent residuals would be at least as smooth as the residuals of the fit, by the von Neumann
  /// ratio.
  double smoothness_p = 1.0;
  /// Probability that independent residuals would change their sign at most as often as the residuals of the fit, by
  /// the Wald-Wolfowitz runs test.
  double runs_p = 1.0;

  /// Returns true if fewer than one in a hundred fits with independent residuals would show this pattern.
  bool is_systematic() const;
  /// Returns the factor by which the correlation of the residuals increases the variance of their mean: (1 + r)/(1 -
  /// r), where r is the correlation of neighbouring residuals. This factor assumes that the correlation falls off
  /// geometrically with distance. Returns 1 if the residuals are not systematic.
  double variance_factor() const;
};

/// Finds the pattern in the residuals of a fit.
///
/// The von Neumann ratio of the residuals r_k is sum (r_(k+1) - r_k)^2 / sum r_k^2. The ratio is compared with its
/// distribution for data with independent normal errors. This distribution is approximated by a beta distribution on
/// (0, 4) with the exact mean and variance, which depend on the Jacobian [DW1951]. Residuals that are only rounding
/// have no pattern.
/// @param residuals  weighted residuals in the order of the points
/// @param basis      orthonormal basis of the columns of the Jacobian of the residuals
[[nodiscard]] ResidualPattern residual_pattern(const Eigen::VectorXd& residuals, const Eigen::MatrixXd& basis);

}  // namespace floc
