#include "floc/assembly/diameters.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace floc {
namespace {

/// Returns the diameter d at which (d^s - min^s)/(max^s - min^s) = share, with s = 1 - exponent. The formula starts
/// from min or from max, so that no power overflows.
double power_law_quantile(const DiameterDistribution& d, double share) {
  const double s = 1.0 - d.exponent, range = std::log(d.max / d.min);
  // If s is this small, d^s is a linear function of ln d up to rounding errors.
  if (std::abs(s * range) < 1e-9) return d.min * std::exp(share * range);
  if (s > 0.0) return d.max * std::exp(std::log1p((1.0 - share) * std::expm1(-s * range)) / s);
  return d.min * std::exp(std::log1p(share * std::expm1(s * range)) / s);
}

/// Returns the probability that a standard normal variable lies between x and y, x <= y. If both are positive, it is
/// computed from the mirrored interval, because a difference of two numbers close to 1 would lose digits.
double normal_share(double x, double y) {
  if (x > 0.0) return normal_share(-y, -x);
  const auto below = [](double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); };
  return below(y) - below(x);
}

/// Returns the value y between low and high at which normal_share(low, y) is `share` times normal_share(low, high). It
/// is found by bisection, exactly up to rounding.
double normal_quantile(double low, double high, double share) {
  const double all = normal_share(low, high);
  double inside = low, outside = high;
  constexpr int kHalvings = 60;
  for (int k = 0; k < kHalvings && inside < outside; ++k) {
    const double middle = 0.5 * (inside + outside);
    (normal_share(low, middle) < share * all ? inside : outside) = middle;
  }
  return 0.5 * (inside + outside);
}

double in_deviations(const DiameterDistribution& d, double diameter) {
  return std::log(diameter / d.median) / d.sigma;
}

double lognormal_quantile(const DiameterDistribution& d, double share) {
  return d.median *
         std::exp(d.sigma * normal_quantile(in_deviations(d, d.min), in_deviations(d, d.max), share));
}

}  // namespace

double diameter_quantile(const DiameterDistribution& d, double share) {
  assert(0.0 <= share && share <= 1.0);
  if (share == 0.0) return d.min;
  if (share == 1.0) return d.max;
  const bool is_power = d.kind == DiameterDistribution::Kind::power_law;
  return std::clamp(is_power ? power_law_quantile(d, share) : lognormal_quantile(d, share), d.min, d.max);
}

std::vector<double> equally_spaced_diameters(const DiameterDistribution& d, int n) {
  using Kind = DiameterDistribution::Kind;
  if (d.kind == Kind::list) return d.values;
  std::vector<double> diameter(n, d.min);
  for (int i = 0; i < n; ++i) {
    if (d.kind == Kind::uniform) diameter[i] = n == 1 ? d.max : d.min + (d.max - d.min) * i / (n - 1);
    if (d.kind == Kind::bidisperse) diameter[i] = i < d.share_of_large * n ? d.max : d.min;
    if (d.kind == Kind::power_law || d.kind == Kind::lognormal)
      diameter[i] = n == 1 ? d.max : diameter_quantile(d, static_cast<double>(i) / (n - 1));
  }
  return diameter;
}

double share_within_bounds(const DiameterDistribution& d) {
  return normal_share(in_deviations(d, d.min), in_deviations(d, d.max));
}

}  // namespace floc
