#include <algorithm>
#include <cmath>
#include <numbers>

#include "floc/base/infinity.h"
#include "floc/fitting/force_distribution.h"

namespace floc {
namespace {

const double kHalfRootPi = 0.5 * std::sqrt(std::numbers::pi);

double exponential(double rate, RandomStream& random) {
  return -std::log(1.0 - random.uniform()) / rate;
}

/// Force distribution power_exponential() with its constants: a power law for f < 1, and an exponential for f > 1.
struct PowerExponential {
  double alpha, beta, k;
  explicit PowerExponential(double a)
      : alpha(a), beta(std::sqrt((1.0 - a) * (2.0 - a))), k(1.0 / (1.0 / (1.0 - a) + 1.0 / beta)) {}

  double log_density(double f) const {
    return std::log(k) + (f < 1.0 ? -alpha * std::log(f) : beta * (1.0 - f));
  }
  double cumulative(double f) const {
    if (f < 1.0) return k / (1.0 - alpha) * std::pow(f, 1.0 - alpha);
    return 1.0 - k / beta * std::exp(beta * (1.0 - f));
  }
  double draw(RandomStream& random) const {
    const double u = random.uniform() * (1.0 - alpha) / k;
    return u < 1.0 ? std::pow(u, 1.0 / (1.0 - alpha)) : 1.0 + exponential(beta, random);
  }
};

/// Force distribution quadratic_exponential() with its constants a and b. Two conditions give a and b: the norm (the
/// integral of the distribution) and the mean are 1. Let I_m be the integral of f^m exp(-f^2 - beta f) over f > 0. The
/// conditions are
///   norm  a (1/beta - b I_0) = 1,  mean  a (1/beta^2 - b I_1) = 1
struct QuadraticExponential {
  double beta, b, a;
  explicit QuadraticExponential(double rate) : beta(rate) {
    const double I0 = kHalfRootPi * std::exp(0.25 * beta * beta) * std::erfc(0.5 * beta);
    const double I1 = 0.5 - 0.5 * beta * I0;
    b = (1.0 / (beta * beta) - 1.0 / beta) / (I1 - I0);
    a = 1.0 / (1.0 / beta - b * I0);
  }

  bool is_positive() const { return b <= 1.0 && a > 0.0; }
  double log_density(double f) const {
    if (!is_positive()) return -kInfinity;
    return std::log(a) + std::log1p(-b * std::exp(-f * f)) - beta * f;
  }
  double cumulative(double f) const {
    const double shifted = std::exp(0.25 * beta * beta) * (std::erf(f + 0.5 * beta) - std::erf(0.5 * beta));
    return a * (-std::expm1(-beta * f) / beta - b * kHalfRootPi * shifted);
  }
  double draw(RandomStream& random) const {
    const double bound = std::max(1.0, 1.0 - b);
    while (true) {
      const double f = exponential(beta, random);
      if (random.uniform() * bound < 1.0 - b * std::exp(-f * f)) return f;
    }
  }
};

template <class Law>
ForceLaw law_of(const char* name, const char* parameter, double low, double high) {
  return {name,
          parameter,
          low,
          high,
          [](double x, double f) { return Law(x).log_density(f); },
          [](double x, double f) { return Law(x).cumulative(f); },
          [](double x, RandomStream& random) { return Law(x).draw(random); }};
}

}  // namespace

const ForceLaw& power_exponential() {
  static const ForceLaw law = law_of<PowerExponential>("power_exponential", "alpha", -20.0, 0.999);
  return law;
}

const ForceLaw& quadratic_exponential() {
  // The upper limit of beta is just below 2.19093, where b = 1 and the density vanishes at f = 0.
  static const ForceLaw law = law_of<QuadraticExponential>("quadratic_exponential", "beta", 0.05, 2.19092);
  return law;
}

}  // namespace floc
