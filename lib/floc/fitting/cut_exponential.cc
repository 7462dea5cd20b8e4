#include "floc/fitting/cut_exponential.h"

#include <algorithm>
#include <cmath>

namespace floc {
namespace {

constexpr int kMinValues = 10;

/// Returns the mean of a random variable x with density ~ exp(-t x) on [0, 1], accurate to rounding for any t.
double mean_in_unit(double t) {
  // For small t, the formula loses digits, and a series is used. The first neglected term of the series is below
  // rounding.
  if (std::abs(t) < 1e-2) return 0.5 - t / 12.0 + t * t * t / 720.0;
  return 1.0 / t - 1.0 / std::expm1(t);
}

/// Returns the variance of a random variable x with density ~ exp(-t x) on [0, 1].
double variance_in_unit(double t) {
  if (std::abs(t) < 1e-1) return 1.0 / 12.0 - t * t / 240.0 + t * t * t * t / 6048.0;
  const double s = std::sinh(std::clamp(0.5 * t, -300.0, 300.0));
  return 1.0 / (t * t) - 0.25 / (s * s);
}

double mean_of(double b, const CutSample& window) {
  return std::isinf(window.width) ? 1.0 / b : window.width * mean_in_unit(b * window.width);
}

double variance_of(double b, const CutSample& window) {
  return std::isinf(window.width) ? 1.0 / (b * b)
                                  : window.width * window.width * variance_in_unit(b * window.width);
}

}  // namespace

CutSample cut_sample(const std::vector<double>& values, double low, double high) {
  CutSample sample{high - low, 0, 0.0};
  for (const double x : values)
    if (low <= x && x <= high) ++sample.n, sample.mean += x - low;
  if (sample.n > 0) sample.mean /= sample.n;
  return sample;
}

ExponentEstimate fit_exponent(const std::vector<CutSample>& windows) {
  ExponentEstimate fit;
  double sum = 0.0;
  bool has_tail = false;
  for (const CutSample& w : windows) {
    fit.n += w.n, sum += w.n * w.mean;
    has_tail = has_tail || (w.n > 0 && std::isinf(w.width));
  }
  if (fit.n < kMinValues || !(sum > 0.0)) return fit;
  const auto excess = [&](double b) {
    double left = -sum;
    for (const CutSample& w : windows)
      if (w.n > 0) left += w.n * mean_of(b, w);
    return left;
  };
  // The root of excess(b), a falling function, is the exponent with the largest likelihood. If no window has an upper
  // end, the root is n/sum, where n is the number of values, and `sum` the sum of their distances from the lower ends
  // of the windows. If there is no root within a factor kFar of n/sum, all values lie at one end of their windows, and
  // the likelihood has no maximum.
  const double tail = fit.n / sum;
  constexpr double kFar = 1e6;
  double low = has_tail ? tail / kFar : -kFar * tail, high = kFar * tail;
  if (!(excess(low) > 0.0) || !(excess(high) < 0.0)) return fit;
  constexpr int kHalvings = 100;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (low + high);
    (excess(middle) > 0.0 ? low : high) = middle;
  }
  fit.b = 0.5 * (low + high);
  double information = 0.0;
  for (const CutSample& w : windows)
    if (w.n > 0) information += w.n * variance_of(fit.b, w);
  fit.error = 1.0 / std::sqrt(information);
  fit.found = std::isfinite(fit.error);
  return fit;
}

}  // namespace floc
