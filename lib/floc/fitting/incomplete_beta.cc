#include "floc/fitting/incomplete_beta.h"

#include <cassert>
#include <cmath>
#include <limits>

namespace floc {
namespace {

/// Returns the continued fraction 1/(1 + d1/(1 + d2/(1 + ...))) of the incomplete beta function, by the method of Lentz.
double continued_fraction(double a, double b, double x) {
  constexpr double kTiny = 1e-300, kRounding = 1e-14;
  constexpr int kTerms = 1000;
  const auto away_from_zero = [](double v) { return std::abs(v) < kTiny ? kTiny : v; };
  double c = std::numeric_limits<double>::infinity(), d = 1.0, fraction = 1.0;
  for (int i = 1; i <= kTerms; ++i) {
    const double m = std::floor(0.5 * i);
    const double term = i % 2 == 0 ? m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m))
                                   : -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    d = 1.0 / away_from_zero(1.0 + term * d);
    c = away_from_zero(1.0 + term / c);
    fraction *= c * d;
    if (std::abs(1.0 - c * d) < kRounding) break;
  }
  return fraction;
}

}  // namespace

double incomplete_beta(double a, double b, double x) {
  assert(a > 0 && b > 0 && 0 <= x && x <= 1);
  if (x <= 0.0) return 0.0;
  if (x >= 1.0) return 1.0;
  // The continued fraction converges fast for x below about the mean. For larger x, I_x(a, b) = 1 - I_(1-x)(b, a) is
  // used.
  if (x > (a + 1.0) / (a + b + 2.0)) return 1.0 - incomplete_beta(b, a, 1.0 - x);
  const double log_front =
      std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x);
  return std::exp(log_front) / a * continued_fraction(a, b, x);
}

}  // namespace floc
