#include "floc/fitting/dynamic_compaction.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "floc/base/random.h"

namespace floc {
namespace {

using testing::HasSubstr;

// Parameters of [SVI2024]: e_min, De, C, A, s_m, a, b.
constexpr double kTruth[7] = {0.76, 1.0, 0.24, 0.475, 1.55, 0.74, 2.3};

/// Returns the void ratio of the compaction law, computed independently of the library.
/// @param plateau_at  pressure at which the plateau is evaluated
double law(double plateau_at, double p, double sc, double se) {
  const double e_max = 0.76 + 1.0 / (1.0 + 0.24 * std::log(plateau_at / 0.01));
  const double x = sc / std::sqrt(p * se) / 0.045;
  const double right = 1.0 / (0.475 * std::pow(x, 0.74) + (1 / 1.55 - 0.475) * std::pow(x, 2.3));
  return 0.76 + (e_max - 0.76) / (1.0 + right);
}

double printed(double p, double sc, double se) {
  return law(sc * sc / se, p, sc, se);
}

/// The published series of samples: pressures p from p_0 to 100 p_0, and eta* = sc/sqrt(p se) from 1e-4 to 15.
std::vector<CompactedSample> sweep(double noise, RandomStream& random) {
  std::vector<CompactedSample> samples;
  for (const double p : {0.01, 0.1, 0.5, 1.0})
    for (const double se : {500.0, 2e3, 1e4, 5e4, 2e5})
      for (const double eta : {1e-4, 1e-3, 3e-3, 0.01, 0.03, 0.05, 0.1, 0.2, 0.5, 2.0, 15.0}) {
        const double sc = eta * std::sqrt(p * se);
        if (sc <= 0.1 * se) samples.push_back({law(p, p, sc, se) + noise * random.normal(), p, sc, se});
      }
  return samples;
}

/// Samples that follow the printed form of the law. The pressures extend to 1e4 p_0, so that some samples are dense.
std::vector<CompactedSample> printed_samples(double noise, RandomStream& random) {
  std::vector<CompactedSample> samples;
  for (const double p : {1e-2, 1.0, 10.0, 100.0})
    for (const double se : {10.0, 100.0, 1000.0})
      for (double sc = std::sqrt(0.011 * se); sc < std::sqrt(30 * se); sc *= 2.2)
        samples.push_back({printed(p, sc, se) + noise * random.normal(), p, sc, se});
  return samples;
}

CompactionReference as_printed() {
  CompactionReference reference;
  reference.plateau = PlateauPressure::critical;
  return reference;
}

void expect_published(const CompactionFit& fit) {
  ASSERT_TRUE(fit.found()) << fit.failure_reason;
  for (std::size_t k = 0; k < 7; ++k) {
    ASSERT_TRUE(fit.parameters[k].value) << fit.parameters[k].name;
    EXPECT_NEAR(*fit.parameters[k].value / kTruth[k], 1.0, 1e-6) << fit.parameters[k].name;
  }
  EXPECT_LT(fit.rms, 1e-9);
}

TEST(DynamicCompaction, RecoversThePublishedParameters) {
  RandomStream random(1, 0);
  const auto fit = fit_dynamic_compaction(sweep(0.0, random), {});
  expect_published(fit);
  EXPECT_TRUE(fit.beside_plateau.empty());
  expect_published(fit_dynamic_compaction(printed_samples(0.0, random), as_printed()));
}

TEST(DynamicCompaction, TheReferencePressureIsFreeToChoose) {
  RandomStream random(1, 0);
  CompactionReference reference;
  reference.p_D = 0.3;
  const auto fit = fit_dynamic_compaction(sweep(0.0, random), reference);
  ASSERT_TRUE(fit.found());
  // The law implies 1/De(p_D) = 1/De(p_0) + C ln(p_D/p_0).
  EXPECT_NEAR(1.0 / *fit.parameters[1].value, 1.0 + 0.24 * std::log(30.0), 1e-6);
  EXPECT_NEAR(*fit.parameters[2].value, 0.24, 1e-6);
}

/// Fits 40 noisy copies of the samples. Expects for each parameter that at least 34 of the 40 confidence intervals (95
/// %) contain the true value. By chance, fewer than 34 intervals contain it with the probability 1/300.
void expect_coverage(std::vector<CompactedSample> (*draw)(double, RandomStream&),
                     const CompactionReference& reference) {
  constexpr int kRepeats = 40;
  RandomStream random(2, 0);
  int covered[7] = {};
  for (int r = 0; r < kRepeats; ++r) {
    const auto fit = fit_dynamic_compaction(draw(0.002, random), reference);
    ASSERT_TRUE(fit.found()) << fit.failure_reason;
    for (std::size_t k = 0; k < 7; ++k) {
      const FittedParameter& p = fit.parameters[k];
      covered[k] += p.low95 && *p.low95 <= kTruth[k] && kTruth[k] <= *p.high95;
    }
  }
  for (int k = 0; k < 7; ++k) EXPECT_GE(covered[k], 34) << k;
}

TEST(DynamicCompaction, IntervalsCoverTheTruth) {
  expect_coverage(sweep, {});
  expect_coverage(printed_samples, as_printed());
}

TEST(DynamicCompaction, ThePrintedFormDoesNotIdentifyTheDenseSide) {
  RandomStream random(5, 0);
  for (const double noise : {0.0, 0.002, 0.002, 0.002, 0.01, 0.01, 0.01}) {
    const auto samples = sweep(noise, random);
    const auto fit = fit_dynamic_compaction(samples, as_printed());
    ASSERT_TRUE(fit.found()) << fit.failure_reason;
    // The samples of the series with eta* < 0.1 have p_crit < p_0. The fit leaves them out.
    for (const int i : fit.used) EXPECT_GE(samples[i].sc / std::sqrt(samples[i].p * samples[i].se), 0.0999);
    for (const std::size_t k : {3u, 5u}) {
      const FittedParameter& p = fit.parameters[k];
      EXPECT_FALSE(p.identified) << p.name;
      EXPECT_FALSE(p.value);
      EXPECT_THAT(fit.warnings,
                  testing::Contains(HasSubstr(p.name + " is not identified by these data: fewer")));
    }
  }
}

TEST(DynamicCompaction, SamplesBesideThePlateauAreFlaggedNotFitted) {
  RandomStream random(6, 0);
  auto samples = sweep(0.002, random);
  std::vector<int> beside;
  for (int i = 0; i < static_cast<int>(samples.size()); ++i) {
    CompactedSample& s = samples[i];
    const double eta = s.sc / std::sqrt(s.p * s.se);
    if (eta < 10.0 || s.sc < 0.01 * s.se) continue;
    // Soft grains overlap, so their void ratio is below the plateau.
    s.e = (1.0 + s.e) * std::pow(1.0 - s.sc / s.se, 3) - 1.0;
    beside.push_back(i);
  }
  samples.push_back({2.2, 0.1, 0.05 * std::sqrt(0.1 * 1e4), 1e4});  // void ratio above any plateau
  beside.push_back(static_cast<int>(samples.size()) - 1);
  const auto fit = fit_dynamic_compaction(samples, {});
  ASSERT_TRUE(fit.found()) << fit.failure_reason;
  ASSERT_GT(beside.size(), 5u);
  EXPECT_EQ(fit.beside_plateau, beside);
  EXPECT_EQ(fit.used.size() + beside.size(), samples.size());
  for (std::size_t k = 0; k < 7; ++k)
    EXPECT_NEAR(*fit.parameters[k].value, kTruth[k], 4 * *fit.parameters[k].standard_error)
        << fit.parameters[k].name;
}

TEST(DynamicCompaction, RepeatedRunsTellTheScatterFromWhatTheLawMisses) {
  RandomStream random(7, 0);
  auto samples = sweep(0.002, random);
  for (const auto& s : sweep(0.002, random)) samples.push_back(s);
  const auto fit = fit_dynamic_compaction(samples, {});
  ASSERT_TRUE(fit.errors_from_runs);
  ASSERT_EQ(fit.error_parts.size(), 7u);
  // The samples follow the law, so the part of the error that stands for deviations from the law must be small compared
  // with the part due to scatter. The scatter is determined to 8 % by about 80 pairs of runs.
  for (const CompactionErrorParts& parts : fit.error_parts) EXPECT_LT(parts.law, 0.45 * parts.scatter);
  for (CompactedSample& s : samples) s.e += 0.01 * std::sin(40 * std::log(s.se));
  const auto missed = fit_dynamic_compaction(samples, {});
  ASSERT_TRUE(missed.found()) << missed.failure_reason;
  for (const CompactionErrorParts& parts : missed.error_parts) EXPECT_GT(parts.law, parts.scatter);
  EXPECT_THAT(missed.warnings, testing::Contains(HasSubstr("the law misses the void ratio e by")));
}

TEST(DynamicCompaction, SamplesBelowThePoleAreLeftOutAndSaid) {
  RandomStream random(3, 0);
  auto samples = printed_samples(0.0, random);
  const std::size_t n = samples.size();
  samples.push_back({1.7, 0.01, 0.1, 100.0});  // p_crit = 1e-4, below p_0
  const auto fit = fit_dynamic_compaction(samples, as_printed());
  ASSERT_TRUE(fit.found());
  EXPECT_EQ(fit.used.size(), n);
  EXPECT_THAT(fit.warnings.front(), HasSubstr("1 of the"));
}

TEST(DynamicCompaction, OnePlateauDoesNotTellItsTwoParameters) {
  std::vector<CompactedSample> samples, at_one_pressure;
  const double se = 100.0, sc = 3.0;
  for (double p = 1e-5; p < 1e3; p *= 1.7) samples.push_back({printed(p, sc, se), p, sc, se});
  for (double eta = 1e-4; eta < 20.0; eta *= 1.7)
    at_one_pressure.push_back(
        {law(0.5, 0.5, eta * std::sqrt(0.5 * se), se), 0.5, eta * std::sqrt(0.5 * se), se});
  for (const auto& fit :
       {fit_dynamic_compaction(samples, as_printed()), fit_dynamic_compaction(at_one_pressure, {})}) {
    ASSERT_TRUE(fit.found()) << fit.failure_reason;
    EXPECT_FALSE(fit.parameters[1].identified);
    EXPECT_FALSE(fit.parameters[2].identified);
    EXPECT_TRUE(fit.parameters[0].identified);
  }
}

TEST(DynamicCompaction, TooFewSamplesAreRefused) {
  RandomStream random(4, 0);
  auto samples = sweep(0.0, random);
  samples.resize(7);
  EXPECT_THAT(fit_dynamic_compaction(samples, {}).failure_reason, HasSubstr("7 samples"));
}

}  // namespace
}  // namespace floc
