#pragma once

#include <Eigen/Core>

namespace floc {

/// Tests whether the residuals of a fit are noise or follow a pattern along the curve. A pattern appears if the
/// law does not describe the data, or if the curve moves in steps.
struct ResidualPattern {
  double correlation = 0.0;  ///< correlation of neighbouring residuals
  /// Probability that independent residuals of the fit would be as smooth as these, by the von Neumann ratio.
  double smoothness_p = 1.0;
  /// Probability that independent residuals would change their sign as rarely as these, by the Wald-Wolfowitz
  /// runs test.
  double runs_p = 1.0;

  /// Returns true if independent residuals would show this pattern in less than one of a hundred fits.
  bool is_systematic() const;
  /// Returns the factor by which the variance of a mean is larger than for independent residuals, (1 + r)/(1 - r) for
  /// residuals whose correlation r falls off geometrically; 1 unless the residuals are systematic.
  double variance_factor() const;
};

/// Finds the pattern in the residuals of a fit.
///
/// The von Neumann ratio, sum (r_k+1 - r_k)^2 / sum r_k^2, is compared with its distribution for the residuals
/// of this fit to independent normal data. This distribution is approximated by a beta distribution on (0, 4)
/// with the exact mean and variance, which depend on the Jacobian [DW1951]. Residuals that are only rounding
/// have no pattern.
/// @param residuals  weighted residuals in the order of the points
/// @param hat        matrix that projects on the columns of the Jacobian of the residuals
[[nodiscard]] ResidualPattern residual_pattern(const Eigen::VectorXd& residuals, const Eigen::MatrixXd& hat);

/// Returns the matrix that projects on the space of the columns of a matrix; columns of zeros are ignored.
[[nodiscard]] Eigen::MatrixXd projection_on(const Eigen::MatrixXd& columns);

}  // namespace floc
