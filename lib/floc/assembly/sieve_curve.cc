#include "floc/assembly/sieve_curve.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace floc {
namespace {

/// Returns the number of grains between the sizes with the indices k and k + 1 of the curve, up to a factor that is
/// equal for all intervals. Let d1 and d2 be the two sizes, and w the fraction of the mass between them. The mass per
/// unit of ln d is then w/ln(d2/d1). The number of grains is the integral of w/ln(d2/d1) (d/d1)^-Dim with respect to ln
/// d, multiplied by d1^-Dim. The unit of length is the largest size of the curve, so no power overflows if the sizes
/// differ by less than a factor of 1e100.
double number_between(const SieveCurve& curve, int dimension, std::size_t k) {
  const double weight = curve.passing[k + 1] - curve.passing[k];
  const double range = std::log(curve.sizes[k + 1] / curve.sizes[k]);
  return weight * std::pow(curve.sizes[k] / curve.sizes.back(), -dimension) * -std::expm1(-dimension * range) /
         (dimension * range);
}

/// Returns the diameter d below which the fraction `share` of the number of grains in interval k of the curve lies.
/// With the ends d1 and d2 of the interval, d is the solution of (1 - (d/d1)^-Dim)/(1 - (d2/d1)^-Dim) = share.
double quantile_between(const SieveCurve& curve, int dimension, std::size_t k, double share) {
  const double range = std::log(curve.sizes[k + 1] / curve.sizes[k]);
  const double d = curve.sizes[k] * std::exp(-std::log1p(share * std::expm1(-dimension * range)) / dimension);
  return std::clamp(d, curve.sizes[k], curve.sizes[k + 1]);
}

}  // namespace

double passing_at(const SieveCurve& curve, double diameter) {
  const auto above = std::upper_bound(curve.sizes.begin(), curve.sizes.end(), diameter);
  if (above == curve.sizes.begin()) return 0.0;
  if (above == curve.sizes.end()) return 0.01 * curve.passing.back();
  const auto k = static_cast<std::size_t>(above - curve.sizes.begin()) - 1;
  const double part = std::log(diameter / curve.sizes[k]) / std::log(curve.sizes[k + 1] / curve.sizes[k]);
  return 0.01 * (curve.passing[k] + part * (curve.passing[k + 1] - curve.passing[k]));
}

SieveCurve cut_curve(const SieveCurve& curve, double min, double max) {
  const double below = passing_at(curve, min), all = passing_at(curve, max) - below;
  assert(min < max && all > 0.0);
  SieveCurve cut{{min}, {0.0}};
  for (std::size_t k = 0; k < curve.sizes.size(); ++k)
    if (curve.sizes[k] > min && curve.sizes[k] < max) {
      cut.sizes.push_back(curve.sizes[k]);
      cut.passing.push_back((curve.passing[k] - 100.0 * below) / all);
    }
  cut.sizes.push_back(max);
  cut.passing.push_back(100.0);
  return cut;
}

double number_quantile(const SieveCurve& curve, int dimension, double share) {
  const std::size_t n = curve.sizes.size() - 1;
  double total = 0.0;
  for (std::size_t k = 0; k < n; ++k) total += number_between(curve, dimension, k);
  double left = share * total;
  for (std::size_t k = 0; k < n; ++k) {
    const double here = number_between(curve, dimension, k);
    if (left <= here && here > 0.0) return quantile_between(curve, dimension, k, left / here);
    left -= here;
  }
  return curve.sizes.back();
}

}  // namespace floc
