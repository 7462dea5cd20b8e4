#pragma once

#include <Eigen/Core>

namespace floc {

/// Loss function of the residuals. Their scale is the median absolute residual, converted to a normal
/// deviation.
enum class Loss {
  squared,  ///< least squares
  huber,    ///< linear beyond 1.345 scales: 95 % efficient for normal errors
  cauchy,   ///< logarithmic beyond 2.385 scales: the same efficiency, and gross outliers count for nothing
};

/// Returns the weights by which residuals are multiplied so that least squares minimises the loss.
Eigen::VectorXd loss_weights(Loss loss, const Eigen::VectorXd& residuals);

}  // namespace floc
