#pragma once

#include <Eigen/Core>

namespace floc {

/// Loss function of a least-squares fit. The scale of the residuals is their median absolute value times 1.4826, which
/// is the standard deviation if the residuals are normally distributed.
enum class Loss {
  squared,  ///< least squares
  huber,    ///< loss is linear for residuals beyond 1.345 times their scale; 95 % efficient for normal errors
  /// Loss is logarithmic for residuals beyond 2.385 times their scale; 95 % efficient for normal errors. Outliers have
  /// almost no weight.
  cauchy,
};

/// Returns one weight per residual. The minimum of the loss is found by repeated fits: each fit minimises the sum of
/// squares of weight * residual, and the weights are computed from the residuals of the previous fit until nothing
/// changes.
Eigen::VectorXd loss_weights(Loss loss, const Eigen::VectorXd& residuals);

}  // namespace floc
