#pragma once

#include <Eigen/Core>

namespace floc {

/// What large residuals count for. The scale of a residual is the median absolute one, as a normal deviation.
enum class Loss {
  squared,  ///< least squares
  huber,    ///< linear beyond 1.345 scales: 95 % efficient for normal errors
  cauchy,   ///< logarithmic beyond 2.385 scales: the same efficiency, and gross outliers count for nothing
};

/// Weights by which residuals of least squares have to be multiplied to count as the loss counts them.
Eigen::VectorXd loss_weights(Loss loss, const Eigen::VectorXd& residuals);

}  // namespace floc
