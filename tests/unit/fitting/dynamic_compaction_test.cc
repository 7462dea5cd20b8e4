#include "floc/fitting/dynamic_compaction.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "floc/base/random.h"

namespace floc {
namespace {

using testing::HasSubstr;

// [SVI2024]: e_min, De, C, A, s_m, a, b.
constexpr double kTruth[7] = {0.76, 1.0, 0.24, 0.475, 1.55, 0.74, 2.3};

/// The printed form, in its own words.
double printed(double p, double sc, double se) {
  const double p_crit = sc * sc / se;
  const double e_max = 0.76 + 1.0 / (1.0 + 0.24 * std::log(p_crit / 0.01));
  const double x = sc / std::sqrt(p * se) / 0.045;
  const double right = 1.0 / (0.475 * std::pow(x, 0.74) + (1 / 1.55 - 0.475) * std::pow(x, 2.3));
  return 0.76 + (e_max - 0.76) / (1.0 + right);
}

std::vector<CompactedSample> samples_of(double noise, RandomStream& random) {
  std::vector<CompactedSample> samples;
  for (const double p : {1e-2, 1.0, 10.0, 100.0})
    for (const double se : {10.0, 100.0, 1000.0})
      for (double sc = std::sqrt(0.011 * se); sc < std::sqrt(30 * se); sc *= 2.2)
        samples.push_back({printed(p, sc, se) + noise * random.normal(), p, sc, se});
  return samples;
}

TEST(DynamicCompaction, RecoversThePublishedParameters) {
  RandomStream random(1, 0);
  const auto fit = fit_dynamic_compaction(samples_of(0.0, random), {});
  ASSERT_TRUE(fit.found()) << fit.refusal;
  for (std::size_t k = 0; k < 7; ++k)
    EXPECT_NEAR(*fit.parameters[k].value / kTruth[k], 1.0, 1e-6) << fit.parameters[k].name;
  EXPECT_LT(fit.rms, 1e-9);
}

TEST(DynamicCompaction, IntervalsCoverTheTruth) {
  constexpr int kRepeats = 40;
  RandomStream random(2, 0);
  int covered[7] = {};
  for (int r = 0; r < kRepeats; ++r) {
    const auto fit = fit_dynamic_compaction(samples_of(0.002, random), {});
    ASSERT_TRUE(fit.found()) << fit.refusal;
    for (std::size_t k = 0; k < 7; ++k) {
      const FittedParameter& p = fit.parameters[k];
      covered[k] += p.low95 && *p.low95 <= kTruth[k] && kTruth[k] <= *p.high95;
    }
  }
  // 40 repeats of probability 0.95: below 34 in one of three hundred.
  for (const int count : covered) EXPECT_GE(count, 34);
}

TEST(DynamicCompaction, SamplesBelowThePoleAreLeftOutAndSaid) {
  RandomStream random(3, 0);
  auto samples = samples_of(0.0, random);
  const std::size_t n = samples.size();
  samples.push_back({1.7, 0.01, 0.1, 100.0});  // p_crit = 1e-4
  const auto fit = fit_dynamic_compaction(samples, {});
  ASSERT_TRUE(fit.found());
  EXPECT_EQ(fit.used.size(), n);
  EXPECT_THAT(fit.warnings.front(), HasSubstr("1 of the"));
}

TEST(DynamicCompaction, OnePlateauDoesNotTellItsTwoParameters) {
  std::vector<CompactedSample> samples;
  const double se = 100.0, sc = 3.0;
  for (double p = 1e-5; p < 1e3; p *= 1.7) samples.push_back({printed(p, sc, se), p, sc, se});
  const auto fit = fit_dynamic_compaction(samples, {});
  ASSERT_TRUE(fit.found()) << fit.refusal;
  EXPECT_FALSE(fit.parameters[1].identified);
  EXPECT_FALSE(fit.parameters[2].identified);
  EXPECT_TRUE(fit.parameters[0].identified);
}

TEST(DynamicCompaction, TooFewSamplesAreRefused) {
  RandomStream random(4, 0);
  auto samples = samples_of(0.0, random);
  samples.resize(7);
  EXPECT_THAT(fit_dynamic_compaction(samples, {}).refusal, HasSubstr("7 samples"));
}

}  // namespace
}  // namespace floc
