#include "floc/fitting/residual_pattern.h"

#include <algorithm>
#include <cmath>

#include "floc/fitting/incomplete_beta.h"
#include "floc/fitting/regimes.h"

namespace floc {
namespace {

/// Probability of a false alarm: the probability with which each of the two tests finds a pattern in independent
/// residuals.
constexpr double kLevel = 0.005;

double log_choose(int n, int k) {
  return std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0);
}

/// Returns the fraction of sequences with `runs` runs of equal signs, among all exp(log_all) sequences of n_plus
/// positive and n_minus negative signs. To count the sequences, the signs are divided into `runs` alternating runs in
/// all possible ways.
double share_with_runs(int runs, int n_plus, int n_minus, double log_all) {
  const auto ways = [&](int of_plus, int of_minus) {
    if (of_plus < 1 || of_minus < 1 || of_plus > n_plus || of_minus > n_minus) return 0.0;
    return std::exp(log_choose(n_plus - 1, of_plus - 1) + log_choose(n_minus - 1, of_minus - 1) - log_all);
  };
  const int half = runs / 2;
  return runs % 2 == 0 ? 2.0 * ways(half, half) : ways(half + 1, half) + ways(half, half + 1);
}

/// Returns the probability that independent residuals have at most as many runs of equal signs as `r`, if they have as
/// many positive and as many negative signs as `r`.
double runs_probability(const Eigen::VectorXd& r) {
  const auto n = static_cast<int>(r.size());
  const auto n_plus = static_cast<int>((r.array() > 0.0).count());
  int runs = 1;
  for (int k = 1; k < n; ++k) runs += (r[k] > 0.0) != (r[k - 1] > 0.0);
  if (n_plus == 0 || n_plus == n) return 1.0;
  double p = 0.0;
  for (int k = 2; k <= runs; ++k) p += share_with_runs(k, n_plus, n - n_plus, log_choose(n, n_plus));
  return std::min(p, 1.0);
}

/// Returns the changes from each row of a matrix to the next row.
Eigen::MatrixXd steps_of(const Eigen::MatrixXd& m) {
  return m.bottomRows(m.rows() - 1) - m.topRows(m.rows() - 1);
}

/// Returns the probability that a fit to independent data has residuals with a von Neumann ratio below `ratio`.
double smoothness_probability(double ratio, const Eigen::MatrixXd& basis) {
  const auto n = static_cast<double>(basis.rows());
  // The residuals are r = M e with independent errors e, the projector M = 1 - Q Q^T and the basis Q. The ratio is
  // r^T D r/(r^T r), where D = S^T S and S takes the difference of neighbours. Its mean and variance follow from
  // the traces of D M and of (D M)^2. With these formulas, the cost grows in proportion to n and not to its cube.
  const Eigen::MatrixXd steps = steps_of(basis);                               // S Q
  const Eigen::MatrixXd within = steps.transpose() * steps;                    // Q^T D Q
  Eigen::MatrixXd second = Eigen::MatrixXd::Zero(basis.rows(), basis.cols());  // D Q
  second.topRows(steps.rows()) -= steps;
  second.bottomRows(steps.rows()) += steps;
  // The diagonal of D is 2 except for 1 at both ends, and its neighbours are -1.
  const double trace_of_d = 2.0 * (n - 1.0), squares_of_d = 6.0 * n - 8.0;
  const double dof = n - static_cast<double>(basis.cols());
  const double trace = trace_of_d - within.trace();
  const double square = squares_of_d - 2.0 * second.squaredNorm() + within.squaredNorm();
  const double mean = trace / dof;
  const double variance = (2.0 * square + trace * trace) / (dof * (dof + 2.0)) - mean * mean;
  constexpr double kLargest = 4.0;
  const double m = mean / kLargest, v = variance / (kLargest * kLargest);
  if (!(v > 0.0) || !(m > 0.0) || !(m < 1.0)) return 1.0;
  const double both = m * (1.0 - m) / v - 1.0;
  if (!(both > 0.0)) return 1.0;
  return incomplete_beta(m * both, (1.0 - m) * both, std::clamp(ratio / kLargest, 0.0, 1.0));
}

}  // namespace

bool ResidualPattern::is_systematic() const {
  return smoothness_p < kLevel || runs_p < kLevel;
}

double ResidualPattern::variance_factor() const {
  // Upper limit of the correlation. Correlated residuals count as a smaller number of independent residuals. At a
  // correlation of 1, this number would be zero.
  constexpr double kMost = 0.9;
  if (!is_systematic()) return 1.0;
  const double r = std::clamp(correlation, 0.0, kMost);
  return (1.0 + r) / (1.0 - r);
}

ResidualPattern residual_pattern(const Eigen::VectorXd& residuals, const Eigen::MatrixXd& basis) {
  const Eigen::Index n = residuals.size();
  ResidualPattern pattern;
  constexpr double kMinFree = 2.5;
  const double squares = residuals.squaredNorm();
  const bool is_rounding = squares < static_cast<double>(n) * kRoundingOfTables * kRoundingOfTables;
  if (is_rounding || static_cast<double>(n - basis.cols()) < kMinFree) return pattern;
  const Eigen::VectorXd steps = residuals.tail(n - 1) - residuals.head(n - 1);
  pattern.correlation = residuals.head(n - 1).dot(residuals.tail(n - 1)) / squares;
  pattern.smoothness_p = smoothness_probability(steps.squaredNorm() / squares, basis);
  pattern.runs_p = runs_probability(residuals);
  return pattern;
}

}  // namespace floc
