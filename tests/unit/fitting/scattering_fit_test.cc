#include "floc/fitting/scattering_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace floc {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

/// Returns the intensity of the law in bins of k from 0.1 to 4. If `speckles` is given, the value of each bin is a mean
/// of n exponentially distributed intensities.
/// @param speckles  engine of random numbers; null for the exact intensity
std::vector<ScatteredPoint> points_of(double I0, double xi, double dF, std::int64_t n, std::mt19937* speckles) {
  std::vector<ScatteredPoint> points;
  for (double k = 0.1; k < 4.0; k *= 1.1) {
    double I = scattered_intensity(I0, xi, dF, k);
    if (speckles != nullptr)
      I *= std::gamma_distribution<double>(static_cast<double>(n), 1.0 / static_cast<double>(n))(*speckles);
    points.push_back({k, I, n});
  }
  return points;
}

TEST(ScatteringFit, OfTheLawItselfIsItsParameters) {
  // With this many wave vectors n per bin, the bias 1/(2n) of the logarithm of the intensity is negligible.
  const ScatteringFit fit = fit_scattering(points_of(2.5, 9.0, 1.6, 1000000000, nullptr), 0.0, 4.0);
  ASSERT_TRUE(fit.found());
  EXPECT_NEAR(*fit.parameters[0].value, 2.5, 1e-7);
  EXPECT_NEAR(*fit.parameters[1].value, 9.0, 1e-7);
  EXPECT_NEAR(*fit.parameters[2].value, 1.6, 1e-7);
  EXPECT_EQ(fit.n_points, 39);
  EXPECT_NEAR(fit.low, 0.1, 1e-12);
  EXPECT_LT(fit.rms, 1e-7);
}

TEST(ScatteringFit, ErrorsAreThoseOfSpeckles) {
  // 400 fits with few wave vectors per bin. The bias must be below its error, and about 95 % of the 95 % intervals must
  // contain the true value. The fraction of these intervals has a standard deviation of 0.011. It may also deviate by
  // one or two per cent because the stated errors are linearised.
  constexpr int kFits = 400;
  std::mt19937 engine(5);
  int n_xi = 0, n_dF = 0;
  double sum = 0.0, chi = 0.0;
  for (int k = 0; k < kFits; ++k) {
    const ScatteringFit fit = fit_scattering(points_of(1.0, 10.0, 1.8, 12, &engine), 0.0, 4.0);
    ASSERT_TRUE(fit.found());
    const FittedParameter &xi = fit.parameters[1], &dF = fit.parameters[2];
    n_xi += *xi.low95 <= 10.0 && 10.0 <= *xi.high95;
    n_dF += *dF.low95 <= 1.8 && 1.8 <= *dF.high95;
    sum += std::log(*xi.value / 10.0) / (*xi.standard_error / *xi.value);
    chi += fit.chi_square / kFits;
  }
  EXPECT_NEAR(n_xi / double(kFits), 0.95, 0.04);
  EXPECT_NEAR(n_dF / double(kFits), 0.95, 0.04);
  EXPECT_LT(std::abs(sum / kFits), 0.2);
  EXPECT_NEAR(chi, 1.0, 0.1);
}

TEST(ScatteringFit, RangeIsTheOneAskedFor) {
  std::vector<ScatteredPoint> points = points_of(1.0, 9.0, 1.6, 1000000000, nullptr);
  for (ScatteredPoint& p : points)
    if (p.k > 2.0) p.I *= 10.0;
  const ScatteringFit fit = fit_scattering(points, 0.0, 2.0);
  EXPECT_NEAR(*fit.parameters[2].value, 1.6, 1e-6);
  EXPECT_LE(fit.high, 2.0);
}

TEST(ScatteringFit, SaysWhatTheDataDoNotTell) {
  const ScatteringFit few = fit_scattering(points_of(1.0, 9.0, 1.6, 10, nullptr), 0.0, 0.15);
  EXPECT_FALSE(few.found());
  EXPECT_THAT(few.failure_reason, HasSubstr("the law needs 6"));
  // The intensity of a power law has no plateau at small k.
  std::vector<ScatteredPoint> power;
  for (double k = 0.1; k < 4.0; k *= 1.1) power.push_back({k, std::pow(k, -1.5), 50});
  EXPECT_THAT(fit_scattering(power, 0.0, 4.0).warnings, Contains(HasSubstr("does not level off")));
  // A constant intensity does not determine a correlation length.
  std::mt19937 engine(2);
  const ScatteringFit flat = fit_scattering(points_of(1.0, 1e-3, 1.0, 50, &engine), 0.0, 4.0);
  ASSERT_TRUE(flat.found());
  EXPECT_FALSE(flat.parameters[1].value);
  EXPECT_FALSE(flat.parameters[2].value);
  for (const int k : {1, 2}) EXPECT_FALSE(flat.parameters[k].low95 || flat.parameters[k].high95) << k;
  std::vector<ScatteredPoint> wrong = points_of(1.0, 9.0, 1.6, 100000, nullptr);
  for (std::size_t k = 0; k < wrong.size(); k += 2) wrong[k].I *= 1.5;
  EXPECT_THAT(fit_scattering(wrong, 0.0, 4.0).warnings, Contains(HasSubstr("does not follow the law")));
}

}  // namespace
}  // namespace floc
