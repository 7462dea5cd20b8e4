#pragma once

#include <Eigen/Core>

namespace floc {

/// Loss function of a fit. The scale of the residuals is their median absolute value times 1.4826; for normally
/// distributed residuals, the scale equals the standard deviation.
enum class Loss {
  squared,  ///< least squares
  huber,    ///< linear beyond 1.345 times the scale of the residuals; 95 % efficient for normal errors
  /// Logarithmic beyond about 2.385 times the scale of the residuals; 95 % efficient for normal errors. Outliers have
  /// almost no weight.
  cauchy,
};

/// Returns one weight per residual. The loss is minimised by repeated fits, until the solution no longer changes. Each
/// fit minimises the sum of (weight * residual)^2, with the weights from the residuals of the previous fit.
Eigen::VectorXd loss_weights(Loss loss, const Eigen::VectorXd& residuals);

}  // namespace floc
