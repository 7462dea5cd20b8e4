#pragma once

#include <Eigen/Core>
#include <functional>

namespace floc {

/// Estimates the 1-norm of A^-1, where A is a symmetric matrix of order n, by Hager's method, started from a
/// constant and from a random vector. The estimate is a lower bound. It is seldom too low by more than a factor of 3.
/// @param apply_inverse  function that returns the product of the inverse with a vector; it is called at most 20 times,
/// seldom more than 5 times
double inverse_norm_estimate(Eigen::Index n,
                             const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& apply_inverse);

}  // namespace floc
