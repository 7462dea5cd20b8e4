#include "floc/fitting/force_distribution.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "floc/base/interruption.h"
#include "floc/base/range.h"

namespace floc {
namespace {

constexpr int kMinForces = 10;
/// The log-likelihood at the ends of a 95 % interval is below its maximum by this amount: half the 95 % quantile of chi
/// squared with one degree of freedom.
constexpr double kDrop95 = 0.5 * 3.841458820694124;
constexpr double kNormal95 = 1.959963984540054;

double log_likelihood(const ForceLaw& law, double parameter, const std::vector<double>& f) {
  double sum = 0.0;
  for (const double x : f) sum += law.log_density(parameter, x);
  return sum;
}

/// Returns the parameter of a force law at which the log-likelihood of the forces f is largest, by golden-section
/// search. The log-likelihood must have a single maximum.
double maximize(const ForceLaw& law, const std::vector<double>& f) {
  constexpr double kGolden = 0.6180339887498949;
  double low = law.low, high = law.high;
  double inner = high - kGolden * (high - low), outer = low + kGolden * (high - low);
  double at_inner = log_likelihood(law, inner, f), at_outer = log_likelihood(law, outer, f);
  while (high - low > 1e-9 * (law.high - law.low)) {
    // If the parameter is too large, the law is not a probability density, and the log-likelihood is -infinity. If both
    // values are -infinity, `>=` makes the search continue at smaller parameters.
    if (at_inner >= at_outer) {
      high = outer, outer = inner, at_outer = at_inner;
      inner = high - kGolden * (high - low);
      at_inner = log_likelihood(law, inner, f);
    } else {
      low = inner, inner = outer, at_inner = at_outer;
      outer = low + kGolden * (high - low);
      at_outer = log_likelihood(law, outer, f);
    }
  }
  return 0.5 * (low + high);
}

/// Returns the parameter at which the log-likelihood is kDrop95 below its maximum. The parameter lies between `best`,
/// the place of the maximum, and `end`. Absent if the log-likelihood falls by less than kDrop95 up to `end`.
std::optional<double> interval_end(const ForceLaw& law, const std::vector<double>& f, double best, double end) {
  const double wanted = log_likelihood(law, best, f) - kDrop95;
  if (log_likelihood(law, end, f) > wanted) return std::nullopt;
  double inside = best, outside = end;
  for (int round = 0; round < 60; ++round) {
    const double middle = 0.5 * (inside + outside);
    (log_likelihood(law, middle, f) > wanted ? inside : outside) = middle;
  }
  return inside;
}

/// Returns the Kolmogorov-Smirnov distance: the largest difference between the cumulative distribution of the sorted
/// forces and the cumulative distribution of a law.
template <class Cumulative>
double distance_of(const std::vector<double>& sorted, const Cumulative& cumulative) {
  const auto n = static_cast<double>(sorted.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const double c = cumulative(sorted[i]);
    largest = std::max({largest, c - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - c});
  }
  return largest;
}

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Divides the forces by their mean, sorts them, and returns the mean.
double normalize(std::vector<double>& forces) {
  const double mean = mean_of(forces);
  for (double& f : forces) f /= mean;
  std::sort(forces.begin(), forces.end());
  return mean;
}

/// Returns the p-value of a fit. Random samples of `n` forces are drawn from the fitted law, and the law is fitted
/// again to each sample. The p-value is the fraction of samples whose Kolmogorov-Smirnov distance from their own fitted
/// law is at least `found`.
template <class Draw, class Distance>
double share_as_far(const ForceFitOptions& options, int n, double found, const Draw& draw,
                    const Distance& distance) {
  constexpr std::uint64_t kPurpose = 0xf0c5;
  RandomStream random(options.seed, kPurpose);
  std::vector<double> sample(static_cast<std::size_t>(n));
  int as_far = 0;
  for (int k = 0; k < options.n_draws; ++k) {
    check_interruption();
    for (double& f : sample) f = draw(random);
    as_far += distance(sample) >= found;
  }
  return (1.0 + as_far) / (1.0 + options.n_draws);
}

ForceFit refused(const std::string& form, int n, const char* what) {
  ForceFit fit;
  fit.form = form;
  fit.n = n;
  fit.failure_reason =
      fmt::format("there are {} forces {}, but the fit needs at least {}", n, what, kMinForces);
  return fit;
}

}  // namespace

ForceFit fit_compressive_forces(const ForceLaw& law, std::vector<double> forces,
                                const ForceFitOptions& options) {
  require_in_range("draws", options.n_draws, ForceFitOptions::kDraws);
  const auto n = static_cast<int>(forces.size());
  if (n < kMinForces) return refused(law.name, n, "> 0");
  ForceFit fit;
  fit.form = law.name;
  fit.n = n;
  fit.mean = normalize(forces);
  const double best = maximize(law, forces);
  FittedParameter p{law.parameter,
                    best,
                    std::nullopt,
                    interval_end(law, forces, best, law.low),
                    interval_end(law, forces, best, law.high),
                    true};
  p.identified = p.low95 && p.high95;
  if (p.identified) p.standard_error = (*p.high95 - *p.low95) / (2 * kNormal95);
  fit.parameters = {p};
  fit.log_likelihood = log_likelihood(law, best, forces);
  fit.distance = distance_of(forces, [&](double f) { return law.cumulative(best, f); });
  const auto distance = [&law](std::vector<double>& sample) {
    normalize(sample);
    const double own = maximize(law, sample);
    return distance_of(sample, [&](double f) { return law.cumulative(own, f); });
  };
  fit.p_value = share_as_far(
      options, n, fit.distance, [&](RandomStream& random) { return law.draw(best, random); }, distance);
  return fit;
}

ForceFit fit_exponential_tail(const std::string& form, const std::vector<double>& forces, double threshold,
                              const ForceFitOptions& options) {
  require_in_range("threshold", threshold, kNotNegativeNumber);
  require_in_range("draws", options.n_draws, ForceFitOptions::kDraws);
  std::vector<double> excess;
  for (const double f : forces)
    if (f > threshold) excess.push_back(f - threshold);
  const auto n = static_cast<int>(excess.size());
  if (n < kMinForces) return refused(form, n, "beyond the threshold");
  ForceFit fit;
  fit.form = form;
  fit.n = n;
  fit.mean = threshold;
  const auto cumulative = [](double f) { return -std::expm1(-f); };
  const double scale = normalize(excess);
  // The excess of a force is the force minus the threshold. For n exponentially distributed excesses, the
  // maximum-likelihood estimate of f_0 is the mean excess, and the standard error of ln f_0 is 1/sqrt(n).
  fit.parameters = {from_logarithm("f_0", std::log(scale), 1.0 / std::sqrt(n), kNormal95)};
  fit.log_likelihood = -n * (1.0 + std::log(scale));
  fit.distance = distance_of(excess, cumulative);
  const auto distance = [&](std::vector<double>& sample) {
    normalize(sample);
    return distance_of(sample, cumulative);
  };
  fit.p_value = share_as_far(
      options, n, fit.distance, [](RandomStream& random) { return -std::log(1.0 - random.uniform()); },
      distance);
  return fit;
}

}  // namespace floc
