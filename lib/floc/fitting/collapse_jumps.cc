#include "floc/fitting/collapse_jumps.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace floc {
namespace {

/// Returns one weight per point. The sum of weight * (1/Phi) over the points is minus the slope of the least-squares
/// line of 1/Phi against ln P.
Eigen::VectorXd slope_weights(const Eigen::VectorXd& log_P) {
  const Eigen::VectorXd d = log_P.array() - log_P.mean();
  return -d / d.squaredNorm();
}

}  // namespace

double distance_of_jumps(const Eigen::MatrixXd& samples, const Eigen::VectorXd& log_P, double lambda) {
  const Eigen::Index n = log_P.size();
  assert(samples.rows() == n && samples.cols() >= 2);
  if (n < 2 || !(lambda > 0.0)) return 0.0;
  const Eigen::MatrixXd steps = samples.bottomRows(n - 1) - samples.topRows(n - 1);
  const Eigen::VectorXd h = log_P.tail(n - 1) - log_P.head(n - 1);
  const double variance = (steps.colwise() - steps.rowwise().mean()).squaredNorm() /
                          static_cast<double>(samples.cols() - 1) / (2.0 * lambda * lambda);
  const auto expected = [&](double g) { return g * g * (1.0 - (-h.array() / g).exp()).sum(); };
  // Bisection finds the g at which expected(g), a growing function, equals `variance`. The search ends at the range of
  // ln P, because there are hardly any jumps if g is larger.
  double low = 1e-9, high = log_P[n - 1] - log_P[0];
  if (expected(high) <= variance) return high;
  constexpr int kHalvings = 60;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = std::sqrt(low * high);
    (expected(middle) < variance ? low : high) = middle;
  }
  return low;
}

int points_in_lag(const Eigen::VectorXd& log_P, double distance) {
  constexpr double kDistances = 2.0, kLeastRange = 0.4;
  constexpr Eigen::Index kLeast = 5;
  const Eigen::Index n = log_P.size();
  const double range = log_P[n - 1] - log_P[0];
  Eigen::Index first = 0;
  while (n - first > kLeast && log_P[first] - log_P[0] < kDistances * distance &&
         log_P[n - 1] - log_P[first + 1] > kLeastRange * range)
    ++first;
  return static_cast<int>(first);
}

bool samples_bend_at(const Eigen::MatrixXd& samples, const Eigen::VectorXd& log_P, int end) {
  constexpr double kDeviations = 2.5;
  const Eigen::Index n = log_P.size();
  assert(end >= 2 && end < n && samples.cols() >= 2);
  // A slope needs two points. If only one point remains from `end` on, the last point before `end` is used too.
  const Eigen::Index beyond = std::max<Eigen::Index>(n - end, 2);
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(n);
  weights.head(end) += slope_weights(log_P.head(end));
  weights.tail(beyond) -= slope_weights(log_P.tail(beyond));
  const Eigen::VectorXd mean = samples.rowwise().mean();
  const double change = weights.dot(mean), slope = slope_weights(log_P).dot(mean);
  const double g = distance_of_jumps(samples, log_P, slope);
  if (!(change > 0.0) || !(g > 0.0)) return change > 0.0;
  double variance = 0.0;
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      variance += weights[i] * weights[j] * std::exp(-std::abs(log_P[i] - log_P[j]) / g);
  variance *= slope * slope * g * g / static_cast<double>(samples.cols());
  return change > kDeviations * std::sqrt(variance);
}

}  // namespace floc
