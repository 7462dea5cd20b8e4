#include "floc/assembly/diameters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace floc {
namespace {

using Kind = DiameterDistribution::Kind;

DiameterDistribution power_law(double min, double max, double exponent) {
  DiameterDistribution d;
  d.kind = Kind::power_law;
  d.min = min;
  d.max = max;
  d.exponent = exponent;
  return d;
}

DiameterDistribution lognormal(double min, double max, double median, double sigma) {
  DiameterDistribution d;
  d.kind = Kind::lognormal;
  d.min = min;
  d.max = max;
  d.median = median;
  d.sigma = sigma;
  return d;
}

/// Returns the fraction of grains smaller than `diameter`, in closed form.
double share_below(const DiameterDistribution& d, double diameter) {
  if (d.kind == Kind::lognormal) {
    const auto below = [&](double x) {
      return std::erf(std::log(x / d.median) / d.sigma / std::numbers::sqrt2);
    };
    return (below(diameter) - below(d.min)) / (below(d.max) - below(d.min));
  }
  const double s = 1.0 - d.exponent;
  if (s == 0.0) return std::log(diameter / d.min) / std::log(d.max / d.min);
  return (std::pow(diameter, s) - std::pow(d.min, s)) / (std::pow(d.max, s) - std::pow(d.min, s));
}

TEST(Diameters, QuantilesInvertTheClosedFormOfTheDistribution) {
  for (const DiameterDistribution& d :
       {power_law(0.05, 1, kUniformByVolume), power_law(0.05, 1, kUniformByArea), power_law(0.3, 2, 1),
        power_law(0.3, 2, 1 + 1e-7), power_law(0.3, 2, 0), power_law(0.3, 2, -2.5), lognormal(0.2, 1, 0.5, 0.4),
        lognormal(0.9, 1, 0.5, 0.2)})
    for (const double share : {1e-3, 0.1, 0.37, 0.5, 0.9, 0.999})
      EXPECT_NEAR(share_below(d, diameter_quantile(d, share)), share, 1e-8) << d.exponent << ' ' << d.sigma;
}

TEST(Diameters, ByVolumeEverySizeFillsTheSameVolume) {
  constexpr int kN = 200001;
  const std::vector<double> d = equally_spaced_diameters(power_law(0.05, 1, kUniformByVolume), kN);
  // The interval from 1/20 to 1 is divided into 20 slices of equal width. Each slice contains 1/20 of the volume or, if
  // the distribution is uniform by area, 1/20 of the area. Five slices are tested.
  double all = 0.0, middle = 0.0;
  for (const double x : d) all += x * x * x, middle += x > 0.525 && x < 0.7625 ? x * x * x : 0.0;
  EXPECT_NEAR(middle / all, 0.25, 2e-4);
  double area = 0.0, of_small = 0.0;
  for (const double x : equally_spaced_diameters(power_law(0.05, 1, kUniformByArea), kN))
    area += x * x, of_small += x < 0.2875 ? x * x : 0.0;
  EXPECT_NEAR(of_small / area, 0.25, 2e-4);
}

TEST(Diameters, TheEndsAreExact) {
  for (const DiameterDistribution& d :
       {power_law(0.05, 1, kUniformByVolume), power_law(1e-3, 1, 100), power_law(1e-3, 1, -100),
        lognormal(0.2, 1, 5, 0.3), lognormal(0.7, 1, 1e-1, 0.3)}) {
    const std::vector<double> sample = equally_spaced_diameters(d, 500);
    EXPECT_EQ(sample.front(), d.min);
    EXPECT_EQ(sample.back(), d.max);
    EXPECT_TRUE(std::is_sorted(sample.begin(), sample.end()));
  }
}

TEST(Diameters, ATightLognormalIsNotCutOff) {
  const DiameterDistribution d = lognormal(0.1, 10, 1, 0.1);
  EXPECT_DOUBLE_EQ(share_within_bounds(d), 1.0);
  EXPECT_NEAR(diameter_quantile(d, 0.5), 1.0, 1e-12);
  // A normal variable lies below its mean plus one standard deviation with the probability 0.8413.
  EXPECT_NEAR(diameter_quantile(d, 0.8413447460685429), std::exp(0.1), 1e-12);
}

TEST(Diameters, ExponentZeroIsTheUniformDistribution) {
  DiameterDistribution uniform;
  uniform.min = 0.5;
  uniform.max = 2.0;
  const std::vector<double> expected = equally_spaced_diameters(uniform, 11);
  const std::vector<double> sample = equally_spaced_diameters(power_law(0.5, 2, 0), 11);
  for (int i = 0; i < 11; ++i) EXPECT_NEAR(sample[i], expected[i], 1e-14);
}

}  // namespace
}  // namespace floc
