#include "floc/fitting/robust.h"

#include <ceres/loss_function.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace floc {

Eigen::VectorXd loss_weights(Loss loss, const Eigen::VectorXd& residuals) {
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(residuals.size());
  if (loss == Loss::squared) return weights;
  Eigen::VectorXd size = residuals.cwiseAbs();
  const auto middle = size.begin() + size.size() / 2;
  std::nth_element(size.begin(), middle, size.end());
  // standard deviation divided by median absolute value, for a normal variable
  constexpr double kNormal = 1.4826;
  const double scale = kNormal * *middle;
  if (scale == 0.0) return weights;
  std::unique_ptr<ceres::LossFunction> rho;
  if (loss == Loss::huber)
    rho = std::make_unique<ceres::HuberLoss>(1.345 * scale);
  else
    rho = std::make_unique<ceres::CauchyLoss>(2.385 * scale);
  for (int i = 0; i < residuals.size(); ++i) {
    double value_and_derivatives[3];
    rho->Evaluate(residuals[i] * residuals[i], value_and_derivatives);
    weights[i] = std::sqrt(value_and_derivatives[1]);
  }
  return weights;
}

}  // namespace floc
