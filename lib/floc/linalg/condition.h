#pragma once

#include <Eigen/Core>
#include <functional>

namespace floc {

/// Estimate of the 1-norm of the inverse of a symmetric matrix of order n, from products with that inverse
/// (Hager's method): a lower bound, seldom too low by more than a factor of 3. At most 10 products.
double inverse_norm_estimate(Eigen::Index n,
                             const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& apply_inverse);

}  // namespace floc
