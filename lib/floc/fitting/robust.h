#pragma once

#include <Eigen/Core>

namespace floc {

/// How much large residuals count. Their scale is the median absolute one, converted to a normal deviation.
enum class Loss {
  squared,  ///< least squares
  huber,    ///< linear beyond 1.345 scales: 95 % efficient for normal errors
  cauchy,   ///< logarithmic beyond 2.385 scales: the same efficiency, and gross outliers count for nothing
};

/// Weights by which the residuals of least squares are multiplied to count as they do in the loss.
Eigen::VectorXd loss_weights(Loss loss, const Eigen::VectorXd& residuals);

}  // namespace floc
