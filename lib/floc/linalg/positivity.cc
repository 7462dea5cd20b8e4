#include "floc/linalg/positivity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace floc {
namespace {

/// Returns the factor ln(1.648 sqrt(n)/oversight) in the bound of [KW1992].
/// @param n          order of the matrix
/// @param oversight  accepted probability that Lanczos' method misses the lowest eigenvalue
double log_of_odds(Eigen::Index n, double oversight) {
  return std::log(1.648 * std::sqrt(static_cast<double>(n)) / oversight);
}

/// Returns the bound of [KW1992] on the error of the lowest Ritz value after `steps` steps of Lanczos' method, divided
/// by the difference between the largest and the lowest eigenvalue.
/// @param n          order of the matrix
/// @param oversight  accepted probability that the error exceeds the bound
double missed_share(Eigen::Index n, int steps, double oversight) {
  return std::pow(log_of_odds(n, oversight) / (2.0 * steps - 1.0), 2);
}

/// Returns a random unit vector; all directions are equally likely.
Eigen::VectorXd random_direction(Eigen::Index n) {
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal;
  Eigen::VectorXd x(n);
  for (double& value : x) value = normal(engine);
  return x.normalized();
}

}  // namespace

Positivity test_positivity(Eigen::Index n, const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& apply,
                           const PositivityOptions& options) {
  Positivity out;
  if (n == 0) return out;
  out.bound = std::numeric_limits<double>::infinity();
  Eigen::VectorXd v = random_direction(n), before = Eigen::VectorXd::Zero(n);
  double beta = 0.0, pivot = 1.0;
  double spread = 0.0;  // Gershgorin's upper bound on the largest eigenvalue of the tridiagonal matrix
  while (out.steps < options.max_steps) {
    Eigen::VectorXd next = apply(v) - beta * before;
    const double alpha = v.dot(next);
    next -= alpha * v;
    const double last_beta = beta;
    beta = next.norm();
    ++out.steps;
    pivot = alpha + options.rounding - last_beta * last_beta / pivot;
    if (!(pivot > 0.0)) {
      out.negative = true;
      return out;
    }
    spread = std::max(spread, alpha + last_beta + beta);
    // Lanczos' method has ended. The vectors of the method span all eigenvectors that contribute to the start vector,
    // so more steps would not find another eigenvalue.
    if (beta <= options.rounding * spread) {
      out.bound = options.rounding;
      return out;
    }
    out.bound = spread * missed_share(n, out.steps, options.oversight);
    if (out.bound <= options.bound) return out;
    before = std::move(v);
    v = next / beta;
  }
  return out;
}

int predicted_steps(Eigen::Index n, double largest_eigenvalue, const PositivityOptions& options) {
  const double steps =
      0.5 * (1.0 + log_of_odds(n, options.oversight) * std::sqrt(largest_eigenvalue / options.bound));
  return static_cast<int>(std::ceil(std::min(steps, 1e9)));
}

}  // namespace floc
