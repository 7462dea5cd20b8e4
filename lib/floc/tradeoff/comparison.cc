#include "floc/tradeoff/comparison.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <numbers>

#include "floc/fitting/student_t.h"
#include "floc/tradeoff/path_fits.h"

namespace floc {
namespace {

constexpr double kQuantile = 0.95;
constexpr double kConfidence = 0.95;
/// A step of the load path counts as elastic if the logarithm of the solid fraction changes by at most kElastic dP/B,
/// with the change of pressure dP and the bulk modulus B.
constexpr double kElastic = 3.0;
/// Changes of the logarithm of the solid fraction up to this value count as zero, because Newton's method alone may
/// cause them.
constexpr double kStill = 1e-5;

/// Returns the probability that at most k of n independent errors lie below the 95 % quantile of their distribution.
double at_most(int k, int n) {
  double sum = 0.0;
  for (int j = 0; j <= k; ++j)
    sum += std::exp(std::lgamma(n + 1.0) - std::lgamma(j + 1.0) - std::lgamma(n - j + 1.0) +
                    j * std::log(kQuantile) + (n - j) * std::log1p(-kQuantile));
  return sum;
}

/// Returns the number x for which the interval [-x, x] contains a normally distributed variable (mean 0, variance 1)
/// with the given probability.
double half_width(double probability) {
  double low = 0.0, high = 10.0;
  while (true) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) return low;
    (std::erf(middle / std::numbers::sqrt2) < probability ? low : high) = middle;
  }
}

/// Returns a factor. The largest of n absolute errors, multiplied by this factor, is an upper confidence limit of the
/// 95 % quantile of the errors, if the errors are normally distributed around zero. Derivation: let q be the quantile
/// of the probability p with p^n = 1 - kConfidence. With the probability 1 - kConfidence, all n errors are below q. The
/// factor is therefore the ratio of the 95 % quantile to q, but at least 1. It is 31 for n = 1, 1.9 for n = 8, and 1
/// from n = 59 on.
double extrapolation(int n) {
  return std::max(1.0, half_width(kQuantile) / half_width(std::pow(1.0 - kConfidence, 1.0 / n)));
}

double relative_difference(int k, const Observation& x, const Observation& reference) {
  const auto at = static_cast<std::size_t>(k);
  const double size = size_of(k, x, reference);
  const double difference = x[at] - reference[at];
  return difference == 0.0 ? 0.0 : difference / size;
}

/// Whether elasticity alone explains the change of the solid fraction from one state to the next.
bool is_elastic(const ObservedState& from, const ObservedState& to) {
  const double change = std::abs(std::log(to.observation[kPhi] / from.observation[kPhi]));
  const double step = std::abs(to.mean_stress - from.mean_stress);
  const double modulus = std::min(from.observation[kB], to.observation[kB]);
  return change <= kStill + (modulus > 0.0 ? kElastic * step / modulus : 0.0);
}

/// Returns the mean of value(k) over all k from 0 to n - 1 for which counts(k) is true and value(k) is finite.
double mean_over(std::size_t n, const std::function<bool(std::size_t)>& counts,
                 const std::function<double(std::size_t)>& value) {
  double sum = 0.0;
  int used = 0;
  for (std::size_t k = 0; k < n; ++k) {
    if (!counts(k)) continue;
    const double at = value(k);
    if (!std::isfinite(at)) continue;
    sum += at;
    ++used;
  }
  return sum / used;  // NaN if there is no finite value
}

/// Returns the relative difference of observable number k between a path and its reference path (the run with the
/// strictest settings from the same seed), averaged over states.
/// @param counts  function that returns whether the state with a given index is included in the mean
double mean_difference(int k, const SamplePath& reference, const SamplePath& path,
                       const std::function<bool(std::size_t)>& counts) {
  return mean_over(path.states.size(), counts, [&](std::size_t i) {
    return relative_difference(k, path.states[i].observation, reference.states[i].observation);
  });
}

/// Index of a state of a path, and index of the state of its reference path under the same load.
using StatePair = std::pair<std::size_t, std::size_t>;

/// Returns pairs of states with the same stage and load: one from a path and one from its reference path. The pairs are
/// in the order of the states. If the paths have equally many states, every state is paired with the state of the same
/// index.
std::vector<StatePair> under_equal_loads(const SamplePath& reference, const SamplePath& path) {
  constexpr double kRounding = 1e-6;
  std::vector<StatePair> pairs;
  if (path.states.size() == reference.states.size()) {
    for (std::size_t i = 0; i < path.states.size(); ++i) pairs.emplace_back(i, i);
    return pairs;
  }
  std::size_t next = 0;
  for (std::size_t i = 0; i < path.states.size(); ++i)
    for (std::size_t j = next; j < reference.states.size(); ++j) {
      const ObservedState &a = path.states[i], &b = reference.states[j];
      if (a.stage != b.stage || std::abs(a.driven_load - b.driven_load) > kRounding * std::abs(b.driven_load))
        continue;
      pairs.emplace_back(i, j);
      next = j + 1;
      break;
    }
  return pairs;
}

bool is_consolidation(std::size_t k) {
  return k == kLambda || k == kAlpha || k == kPhiMax;
}

bool is_of_path(std::size_t k) {
  return declared_observables()[k].source == ObservableSource::path;
}

/// Adds to `out` the errors of those observables that describe a whole path.
void add_paths(const std::vector<const SamplePath*>& references, const std::vector<const SamplePath*>& paths,
               const std::optional<PressureWindow>& window, ObservableErrors& out) {
  for (std::size_t k = 0; k < kObservables; ++k) {
    if (!is_of_path(k) || is_consolidation(k)) continue;
    std::vector<double> differences;
    for (std::size_t s = 0; s < paths.size(); ++s) {
      const double x = value_of_path(k, *paths[s]), truth = value_of_path(k, *references[s]);
      differences.push_back(x == truth ? 0.0 : 2.0 * (x - truth) / (std::abs(x) + std::abs(truth)));
    }
    out[k].mean = mean_of(differences);
  }
  if (!window) return;
  const auto fitted = compare_fits(references, paths, *window);
  for (std::size_t p = 0; p < fitted.size(); ++p) out[kLambda + p].mean = fitted[p];
}

/// For each sample, returns the relative deviation of observable number k from the mean over all samples. For an
/// observable of single states, the deviations in the states of the sample are averaged.
std::vector<double> deviations_of(std::size_t k, const std::vector<const SamplePath*>& paths) {
  std::vector<double> deviations;
  if (is_of_path(k)) {
    std::vector<double> values;
    for (const SamplePath* path : paths) values.push_back(value_of_path(k, *path));
    const double mean = mean_of(values).difference;
    for (const double value : values) deviations.push_back(value / mean - 1.0);
    return deviations;
  }
  // mean[i] is the mean of the observable over all samples in state i. Each deviation is divided by this mean.
  const std::size_t n_states = paths.front()->states.size();
  std::vector<double> mean(n_states);
  for (std::size_t i = 0; i < n_states; ++i)
    mean[i] = mean_over(
        paths.size(), [](std::size_t) { return true; },
        [&](std::size_t s) { return paths[s]->states[i].observation[k]; });
  for (const SamplePath* path : paths)
    deviations.push_back(mean_over(
        n_states, [&](std::size_t i) { return mean[i] != 0.0; },
        [&](std::size_t i) { return path->states[i].observation[k] / mean[i] - 1.0; }));
  return deviations;
}

}  // namespace

double value_of_path(std::size_t k, const SamplePath& path) {
  if (is_of_path(k)) return path_value(static_cast<int>(k), path);
  return mean_over(
      path.states.size(), [](std::size_t) { return true; },
      [&](std::size_t i) { return path.states[i].observation[k]; });
}

Spread spread_of(std::vector<double> errors) {
  std::erase_if(errors, [](double e) { return !std::isfinite(e); });
  std::sort(errors.begin(), errors.end());
  const int n = static_cast<int>(errors.size());
  if (n == 0) return {};
  const auto value = [&](int rank) { return errors[static_cast<std::size_t>(std::min(rank, n) - 1)]; };
  int high = std::max(1, static_cast<int>(std::ceil(kQuantile * n)));
  const double error = value(high);
  while (high < n && at_most(high - 1, n) < kConfidence) ++high;
  return {error, high < n ? value(high) : extrapolation(n) * value(n), n};
}

MeanDifference mean_of(const std::vector<double>& differences) {
  MeanDifference out;
  double sum = 0.0, squares = 0.0;
  for (const double d : differences)
    if (std::isfinite(d)) sum += d, ++out.n;
  if (out.n == 0) return out;
  out.difference = sum / out.n;
  for (const double d : differences)
    if (std::isfinite(d)) squares += (d - out.difference) * (d - out.difference);
  out.standard_error = std::sqrt(squares / ((out.n - 1.0) * out.n));
  out.error95 = out.n > 1 ? student_t_95(out.n - 1) * out.standard_error : out.standard_error;
  return out;
}

std::vector<bool> before_collapse(const SamplePath& reference, const SamplePath& path) {
  std::vector<bool> before(path.states.size(), false);
  for (std::size_t k = 1; k < path.states.size(); ++k) {
    if (path.states[k].stage < 0) continue;
    const bool first = path.states[k].stage != path.states[k - 1].stage;
    const ObservedState& start = first ? reference.states[k - 1] : path.states[k - 1];
    before[k] = (first || before[k - 1]) && is_elastic(reference.states[k - 1], reference.states[k]) &&
                is_elastic(start, path.states[k]) && path.states[k].touching == reference.states[k].touching;
  }
  return before;
}

ObservableErrors compare(const std::vector<const SamplePath*>& references,
                         const std::vector<const SamplePath*>& paths,
                         const std::optional<PressureWindow>& window) {
  ObservableErrors out;
  std::vector<std::vector<bool>> together;
  for (std::size_t s = 0; s < paths.size(); ++s) together.push_back(before_collapse(*references[s], *paths[s]));
  for (int k = 0; k < kObservables; ++k) {
    if (is_of_path(static_cast<std::size_t>(k))) continue;
    std::vector<double> before, after, means;
    for (std::size_t s = 0; s < paths.size(); ++s) {
      const SamplePath &reference = *references[s], &path = *paths[s];
      const std::vector<bool>& same = together[s];
      for (std::size_t i = 0; i < path.states.size(); ++i) {
        const ObservedState& state = path.states[i];
        const Observation& truth = same[i] ? reference.states[i].observation : state.settled;
        (same[i] ? before : after).push_back(std::abs(relative_difference(k, state.observation, truth)));
      }
      means.push_back(mean_difference(k, reference, path, [&](std::size_t i) { return !same[i]; }));
    }
    out[static_cast<std::size_t>(k)] = {spread_of(before), spread_of(after), mean_of(means)};
  }
  add_paths(references, paths, window, out);
  return out;
}

ObservableErrors compare_means(const std::vector<const SamplePath*>& references,
                               const std::vector<const SamplePath*>& paths,
                               const std::optional<PressureWindow>& window) {
  ObservableErrors out;
  std::vector<std::vector<StatePair>> pairs;
  for (std::size_t s = 0; s < paths.size(); ++s) pairs.push_back(under_equal_loads(*references[s], *paths[s]));
  for (int k = 0; k < kObservables; ++k) {
    if (is_of_path(static_cast<std::size_t>(k))) continue;
    std::vector<double> means;
    for (std::size_t s = 0; s < paths.size(); ++s)
      means.push_back(mean_over(
          pairs[s].size(), [](std::size_t) { return true; },
          [&](std::size_t p) {
            const auto [i, j] = pairs[s][p];
            return relative_difference(k, paths[s]->states[i].observation,
                                       references[s]->states[j].observation);
          }));
    out[static_cast<std::size_t>(k)].mean = mean_of(means);
  }
  add_paths(references, paths, window, out);
  return out;
}

ObservableErrors compare_levels(const std::vector<const SamplePath*>& references,
                                const std::vector<std::vector<Observation>>& observations) {
  ObservableErrors out;
  for (int k = 0; k < kObservables; ++k) {
    if (declared_observables()[static_cast<std::size_t>(k)].source != ObservableSource::moduli) continue;
    std::vector<double> errors;
    for (std::size_t s = 0; s < observations.size(); ++s)
      for (std::size_t i = 0; i < observations[s].size(); ++i)
        errors.push_back(
            std::abs(relative_difference(k, observations[s][i], references[s]->states[i].observation)));
    out[static_cast<std::size_t>(k)].before = spread_of(errors);
  }
  return out;
}

ObservableErrors sampling_errors(const std::vector<const SamplePath*>& references, int n,
                                 const std::optional<PressureWindow>& window) {
  ObservableErrors out;
  for (std::size_t k = 0; k < kObservables; ++k)
    if (!is_consolidation(k)) out[k].mean = mean_of(deviations_of(k, references));
  if (window) {
    const auto fitted = sampling_errors_of_fits(references, *window);
    for (std::size_t p = 0; p < fitted.size(); ++p) out[kLambda + p].mean = fitted[p];
  }
  for (ObservableError& error : out) {
    if (error.mean.n == 0) continue;
    error.mean.difference = 0.0;
    const double fewer = std::sqrt(static_cast<double>(error.mean.n) / n);
    error.mean.standard_error *= fewer;
    error.mean.error95 *= fewer;
    error.mean.n = n;
  }
  return out;
}

Observation mean_values(const std::vector<const SamplePath*>& paths,
                        const std::optional<PressureWindow>& window) {
  Observation mean;
  for (std::size_t k = 0; k < kObservables; ++k)
    mean[k] = mean_over(
        paths.size(), [](std::size_t) { return true; },
        [&](std::size_t s) { return value_of_path(k, *paths[s]); });
  if (!window) return mean;
  const ConsolidationValues fitted = fitted_consolidation(paths, *window);
  std::copy(fitted.begin(), fitted.end(), mean.begin() + kLambda);
  return mean;
}

}  // namespace floc
