#include "floc/assembly/diameters.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace floc {
namespace {

/// Returns the diameter d at which (d^s - min^s)/(max^s - min^s) = share, with s = 1 - exponent. To avoid overflow of
/// the powers, d is computed as a multiple of min or max.
double power_law_quantile(const DiameterDistribution& d, double share) {
  const double s = 1.0 - d.exponent, range = std::log(d.max / d.min);
  // If s is close to zero, d^s is linear in ln d up to rounding errors.
  if (std::abs(s * range) < 1e-9) return d.min * std::exp(share * range);
  if (s > 0.0) return d.max * std::exp(std::log1p((1.0 - share) * std::expm1(-s * range)) / s);
  return d.min * std::exp(std::log1p(share * std::expm1(s * range)) / s);
}

/// Returns the probability that a standard normal variable lies between x and y, x <= y. If x and y are positive, the
/// interval from -y to -x, which has the same probability, is used instead. This avoids a difference of two numbers
/// close to 1, in which digits would be lost.
double normal_share(double x, double y) {
  if (x > 0.0) return normal_share(-y, -x);
  const auto below = [](double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); };
  return below(y) - below(x);
}

/// Returns the value y between low and high at which normal_share(low, y) is `share` times normal_share(low, high). The
/// value is found by bisection, exactly up to rounding.
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

/// Returns the volume of the grains between min and a diameter d, divided by the volume of all grains, if the number of
/// grains is proportional to d^-exponent: (d^s - min^s)/(max^s - min^s), with s = Dim + 1 - exponent. The computation
/// avoids overflow of the powers.
double power_law_volume_share(const DiameterDistribution& d, int dimension, double diameter) {
  const double s = dimension + 1.0 - d.exponent, range = std::log(d.max / d.min);
  if (std::abs(s * range) < 1e-9) return std::log(diameter / d.min) / range;
  const double part =
      std::expm1(-std::abs(s) * (s > 0.0 ? std::log(d.max / diameter) : std::log(diameter / d.min))) /
      std::expm1(-std::abs(s) * range);
  return s > 0.0 ? 1.0 - part : part;
}

/// Returns the volume of the grains between min and a diameter, divided by the volume of all grains. If the number of
/// grains of diameter d has a lognormal distribution, the volume of these grains has a lognormal distribution with the
/// same sigma. The logarithm of the median is larger by Dim sigma^2 for the volume [HC1929].
double lognormal_volume_share(const DiameterDistribution& d, int dimension, double diameter) {
  const double shift = dimension * d.sigma;
  const auto share_below = [&](double x) {
    return normal_share(in_deviations(d, d.min) - shift, in_deviations(d, x) - shift);
  };
  return share_below(diameter) / share_below(d.max);
}

}  // namespace

double diameter_quantile(const DiameterDistribution& d, double share) {
  using Kind = DiameterDistribution::Kind;
  assert(0.0 <= share && share <= 1.0);
  if (share == 0.0) return d.min;
  if (share == 1.0) return d.max;
  const double quantile = d.kind == Kind::uniform     ? d.min + (d.max - d.min) * share
                          : d.kind == Kind::power_law ? power_law_quantile(d, share)
                          : d.kind == Kind::lognormal ? lognormal_quantile(d, share)
                                                      : number_quantile(d.curve, d.dimension, share);
  return std::clamp(quantile, d.min, d.max);
}

std::vector<double> equally_spaced_diameters(const DiameterDistribution& d, int n) {
  using Kind = DiameterDistribution::Kind;
  if (d.kind == Kind::list) return d.values;
  std::vector<double> diameter(n, d.min);
  for (int i = 0; i < n; ++i) {
    if (d.kind == Kind::constant) continue;
    if (d.kind == Kind::bidisperse)
      diameter[i] = i < d.share_of_large * n ? d.max : d.min;
    else if (d.quantiles == DiameterDistribution::Quantiles::middle)
      diameter[i] = diameter_quantile(d, (i + 0.5) / n);
    else if (n == 1)
      diameter[i] = d.max;
    else if (d.kind == Kind::uniform)
      diameter[i] = d.min + (d.max - d.min) * i / (n - 1);
    else
      diameter[i] = diameter_quantile(d, static_cast<double>(i) / (n - 1));
  }
  return diameter;
}

std::pair<double, double> smallest_and_largest(const DiameterDistribution& d, int n) {
  if (n < 1 || d.quantiles == DiameterDistribution::Quantiles::ends) return {d.min, d.max};
  return {diameter_quantile(d, 0.5 / n), diameter_quantile(d, (n - 0.5) / n)};
}

double share_within_bounds(const DiameterDistribution& d) {
  return normal_share(in_deviations(d, d.min), in_deviations(d, d.max));
}

std::optional<double> volume_share_below(const DiameterDistribution& d, int dimension, double diameter) {
  using Kind = DiameterDistribution::Kind;
  const bool is_continuous = d.kind == Kind::uniform || d.kind == Kind::power_law ||
                             d.kind == Kind::lognormal || d.kind == Kind::sieve;
  if (!is_continuous || !(d.min < d.max)) return std::nullopt;
  if (diameter <= d.min) return 0.0;
  if (diameter >= d.max) return 1.0;
  // A uniform distribution is a power law with the exponent 0, the default.
  const double share = d.kind == Kind::sieve       ? passing_at(d.curve, diameter)
                       : d.kind == Kind::lognormal ? lognormal_volume_share(d, dimension, diameter)
                                                   : power_law_volume_share(d, dimension, diameter);
  return std::isfinite(share) ? std::optional(share) : std::nullopt;
}

}  // namespace floc
