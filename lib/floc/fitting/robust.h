#pragma once

#include <Eigen/Core>

namespace floc {

/// Loss function of a least-squares fit. The scale of the residuals is their median absolute value times 1.4826, which
/// is the standard deviation if the residuals are normally distributed.
enum class Loss {
  squared,  ///< least squares
  huber,    ///< linear for residuals beyond 1.345 times their scale: 95 % efficient for normal errors
  /// Logarithmic for residuals beyond 2.385 times their scale: 95 % efficient for normal errors, and outliers have
  /// almost no weight.
  cauchy,
};

/// Returns one weight per residual. A fit minimises the loss if it minimises the sum of squares of weight * residual,
/// with the weights computed from its own residuals.
Eigen::VectorXd loss_weights(Loss loss, const Eigen::VectorXd& residuals);

}  // namespace floc
