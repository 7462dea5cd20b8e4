#include "floc/fitting/cut_exponential.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "floc/base/random.h"

namespace floc {
namespace {

constexpr double kEnd = std::numeric_limits<double>::infinity();

/// Draws n values with a density proportional to exp(-b x) on [0, width), by inversion of the cumulative
/// distribution.
std::vector<double> drawn(int n, double b, double width, RandomStream& random) {
  std::vector<double> x;
  for (int k = 0; k < n; ++k) {
    const double share = random.uniform();
    x.push_back(std::isinf(width) ? -std::log1p(-share) / b : -std::log1p(share * std::expm1(-b * width)) / b);
  }
  return x;
}

TEST(CutExponential, OfATailIsTheInverseMean) {
  const ExponentEstimate fit = fit_exponent({{kEnd, 100, 0.25}});
  ASSERT_TRUE(fit.found);
  EXPECT_NEAR(fit.b, 4.0, 1e-12);
  EXPECT_NEAR(fit.error, 0.4, 1e-12);
}

TEST(CutExponential, OfAFlatWindowIsZero) {
  const ExponentEstimate fit = fit_exponent({{2.0, 1200, 1.0}});
  ASSERT_TRUE(fit.found);
  EXPECT_NEAR(fit.b, 0.0, 1e-9);
  // A variable that is uniform in a window of width w has the variance w^2/12.
  EXPECT_NEAR(fit.error, 1.0 / std::sqrt(1200 * 4.0 / 12.0), 1e-12);
}

TEST(CutExponential, ErrorsAreTheScatterOfTheEstimates) {
  RandomStream random(3, 0);
  for (const double b : {-2.0, 0.7, 3.0, 12.0}) {
    constexpr int kRepeats = 400;
    double squares = 0.0, bias = 0.0;
    for (int k = 0; k < kRepeats; ++k) {
      // Two samples of one distribution. The window of the second sample may have another width.
      const double other = b > 0 ? kEnd : 1.5;
      const auto x = drawn(200, b, 0.5, random), y = drawn(100, b, other, random);
      const ExponentEstimate fit = fit_exponent({cut_sample(x, 0.0, 0.5), cut_sample(y, 0.0, other)});
      ASSERT_TRUE(fit.found);
      EXPECT_EQ(fit.n, 300);
      squares += std::pow((fit.b - b) / fit.error, 2) / kRepeats;
      bias += (fit.b - b) / fit.error / kRepeats;
    }
    // The variance from 400 draws is accurate to 7 %.
    EXPECT_NEAR(squares, 1.0, 0.25) << b;
    EXPECT_NEAR(bias, 0.0, 0.2) << b;
  }
}

TEST(CutExponential, AWindowCountsWhatLiesInIt) {
  const CutSample sample = cut_sample({-1.0, 0.125, 0.25, 0.5, 0.75}, 0.125, 0.5);
  EXPECT_EQ(sample.n, 3);  // both ends of the window are included
  EXPECT_NEAR(sample.mean, 0.5 / 3.0, 1e-15);
  EXPECT_EQ(sample.width, 0.375);
}

TEST(CutExponential, TooFewValuesOrAllAtOnePlaceAreSaid) {
  EXPECT_FALSE(fit_exponent({{1.0, 9, 0.4}}).found);
  EXPECT_FALSE(fit_exponent({{kEnd, 50, 0.0}}).found);
  EXPECT_FALSE(fit_exponent({{1.0, 50, 1.0}}).found);
}

}  // namespace
}  // namespace floc
