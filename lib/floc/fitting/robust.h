#pragma once

#include <Eigen/Core>

namespace floc {

/// Loss function of a least-squares fit. The scale of the residuals is their median absolute value, converted
/// to the standard deviation of a normal distribution.
enum class Loss {
  squared,  ///< least squares
  huber,    ///< linear for residuals beyond 1.345 scales: 95 % efficient for normal errors
  /// Logarithmic for residuals beyond 2.385 scales: also 95 % efficient, and outliers have almost no weight.
  cauchy,
};

/// Returns the weights with which least squares of the weighted residuals minimises the loss.
Eigen::VectorXd loss_weights(Loss loss, const Eigen::VectorXd& residuals);

}  // namespace floc
