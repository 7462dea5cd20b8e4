#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "floc/base/random.h"
#include "floc/fitting/consolidation.h"
#include "floc/fitting/loading_path.h"
#include "support/published_consolidation.h"

namespace floc::test {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

double value(const ConsolidationFit& fit, const std::string& name) {
  const FittedParameter* p = fit.find(name);
  return p && p->value ? *p->value : std::nan("");
}

double error(const ConsolidationFit& fit, const std::string& name) {
  return *fit.find(name)->standard_error;
}

TEST(Regimes, TheEndOfThePlateauLiesInItsStatedRange) {
  constexpr int kRepeats = 100;
  int covered = 0;
  RandomStream random(12, 0);
  for (int k = 0; k < kRepeats; ++k) {
    const auto curve = with_relative_noise(kNoRolling.with_plateau(), 0.003, random);
    const auto fit = fit_consolidation(curve, {});
    ASSERT_TRUE(fit.found()) << fit.failure_reason;
    ASSERT_TRUE(fit.regimes->plateau_end);
    const ChangePoint& end = *fit.regimes->plateau_end;
    // The point at P0* belongs to both the plateau and the law.
    covered += end.low95 == 0 || curve.P_star[end.low95 - 1] <= 1.001 * kNoRolling.P0_star;
  }
  // If each interval contains the truth with probability 0.95, the probability is 1e-3 that fewer than 88 of
  // 100 contain it.
  EXPECT_GE(covered, 88);
}

TEST(Regimes, RowsOfOneRegimeAreRefused) {
  RandomStream random(3, 0);
  ConsolidationCurve noisy, elastic;
  for (const double P : published_pressures(0.01)) {
    noisy.P_star.push_back(P);
    noisy.phi.push_back(0.5 * (1 + 1e-3 * random.normal()));
    elastic.P_star.push_back(P);
    elastic.phi.push_back(1 / (2.0 - 1e-3 * P));
  }
  for (const ConsolidationCurve& curve : {noisy, elastic})
    for (const auto law : {ConsolidationLaw::full, ConsolidationLaw::log}) {
      ConsolidationOptions options;
      options.law = law;
      EXPECT_THAT(fit_consolidation(curve, options).failure_reason, HasSubstr("regime I"));
    }
}

TEST(Identity, HoldsInEveryFit) {
  RandomStream random(8, 0);
  for (const Published& set : {kNoRolling, kSmallRolling})
    for (const bool hold : {false, true})
      for (int k = 0; k < 10; ++k) {
        ConsolidationOptions options;
        options.hold_P0 = hold;
        const auto fit = fit_consolidation(with_relative_noise(set.with_plateau(), 0.003, random), options);
        ASSERT_TRUE(fit.found()) << fit.failure_reason;
        EXPECT_NEAR(std::log(value(fit, "P1_star") / value(fit, "P0_star")),
                    (1 / value(fit, "Phi0") - 1 / value(fit, "Phi_max")) / value(fit, "lambda"), 1e-10);
      }
}

TEST(WindowShifts, LambdaOfExactDataDoesNotDependOnTheWindow) {
  ConsolidationOptions options;
  options.window = {0.03, 10.0};
  const auto fit = fit_consolidation(curve_of(kNoRolling.law(), published_pressures(0.01)), options);
  ASSERT_THAT(fit.window_shifts, SizeIs(4));
  for (const WindowShift& s : fit.window_shifts) EXPECT_NEAR(*s.lambda, kNoRolling.lambda, 1e-8) << s.change;
}

TEST(Law, IsFittedOverTwentyFourDecades) {
  const ConsolidationLawParameters law{0.15, 0.8, 0.78, 1.0};
  ConsolidationCurve curve;
  for (int k = -48; k <= 48; ++k) {
    curve.P_star.push_back(std::pow(10.0, 0.25 * k));
    curve.phi.push_back(1 / law.inverse_phi(curve.P_star.back()));
  }
  const auto fit = fit_consolidation(curve, {});
  ASSERT_TRUE(fit.found()) << fit.failure_reason;
  EXPECT_NEAR(value(fit, "lambda"), law.lambda, 1e-8 * law.lambda);
  EXPECT_NEAR(value(fit, "alpha"), law.alpha, 1e-8 * law.alpha);
  EXPECT_NEAR(value(fit, "Phi_max"), law.phi_max, 1e-8 * law.phi_max);
  EXPECT_NEAR(value(fit, "P1_star"), law.P1_star, 1e-8 * law.P1_star);
}

TEST(Law, OfOneRegimeIsFittedOverTwelveDecades) {
  ConsolidationCurve line, power;
  for (int k = -24; k <= 24; ++k) {
    const double P = std::pow(10.0, 0.25 * k);
    line.P_star.push_back(P);
    line.phi.push_back(1 / (3.0 - 0.1 * std::log(P)));
    power.P_star.push_back(P);
    power.phi.push_back(1 / (1.2 + 1e-3 * std::pow(P, -0.8)));
  }
  ConsolidationOptions options;
  options.window = {1e-7, 1e7};
  options.law = ConsolidationLaw::log;
  options.weighting = Weighting::relative;
  EXPECT_NEAR(value(fit_consolidation(line, options), "lambda"), 0.1, 1e-10);
  options.law = ConsolidationLaw::power;
  const auto fit = fit_consolidation(power, options);
  EXPECT_NEAR(value(fit, "alpha"), 0.8, 1e-8);
  EXPECT_NEAR(value(fit, "A"), 1e-3, 1e-10);
  EXPECT_NEAR(value(fit, "Phi_max"), 1 / 1.2, 1e-8);
}

TEST(Profile, IntervalsAreAsymmetricWhereTheLawIs) {
  RandomStream random(21, 0);
  ConsolidationOptions options;
  options.window = {0.03, 14.0};
  const auto curve =
      with_relative_noise(curve_of(kSmallRolling.law(), published_pressures(0.0316)), 0.01, random);
  const auto fit = fit_consolidation(curve, options);
  ASSERT_TRUE(fit.found()) << fit.failure_reason;
  EXPECT_THAT(fit.profiled, testing::ElementsAre("alpha", "Phi_max"));
  const FittedParameter& p = *fit.find("Phi_max");
  // The data rule out small limits Phi_max more clearly than large ones, so the upper end of the interval is farther
  // from the value than the lower end.
  EXPECT_GT(*p.high95 - *p.value, *p.value - *p.low95);
}

/// Returns the mean curve of samples around a published set of parameters. Each sample has its own lambda and its own
/// noise.
ConsolidationCurve mean_of_samples(int n, RandomStream& random) {
  std::vector<ConsolidationCurve> samples;
  for (int s = 0; s < n; ++s) {
    const double lambda = kSmallRolling.lambda * (1 + 0.1 * random.normal());
    Published own = kSmallRolling;
    own.lambda = lambda;
    samples.push_back(with_relative_noise(curve_of(own.law(), published_pressures(0.0316)), 0.003, random));
  }
  return mean_curve(samples);
}

TEST(Samples, ErrorsOfTheirMeanAreTheScatterOfRepeatedMeans) {
  constexpr int kRepeats = 200;
  constexpr int kSamples = 6;
  RandomStream random(5, 0);
  ConsolidationOptions options;
  options.window = {0.03, 14.0};
  double sum = 0, squares = 0, stated = 0;
  for (int k = 0; k < kRepeats; ++k) {
    const auto fit = fit_consolidation(mean_of_samples(kSamples, random), options);
    ASSERT_TRUE(fit.found()) << fit.failure_reason;
    EXPECT_TRUE(fit.errors_from_samples);
    EXPECT_EQ(fit.weighting, Weighting::scatter);
    sum += value(fit, "lambda");
    squares += std::pow(value(fit, "lambda"), 2);
    stated += std::pow(error(fit, "lambda"), 2);
  }
  const double variance = squares / kRepeats - std::pow(sum / kRepeats, 2);
  // The variance of 200 repeats has a standard error of 10 %. The fit estimates its weights from the data, which adds a
  // further error.
  EXPECT_NEAR(stated / kRepeats / variance, 1.0, 0.35);
}

TEST(Samples, TwoOfThemScatterByHalfTheirDifference) {
  std::vector<ConsolidationCurve> samples;
  for (const double lambda : {0.09, 0.11}) {
    ConsolidationCurve& line = samples.emplace_back();
    for (int k = -8; k <= 8; ++k) {
      line.P_star.push_back(std::pow(10.0, 0.25 * k));
      line.phi.push_back(1 / (3.0 - lambda * std::log(line.P_star.back())));
    }
  }
  ConsolidationOptions options;
  options.law = ConsolidationLaw::log;
  options.window = {1e-3, 1e3};
  const auto fit = fit_consolidation(mean_curve(samples), options);
  ASSERT_TRUE(fit.found()) << fit.failure_reason;
  EXPECT_TRUE(fit.errors_from_samples);
  EXPECT_NEAR(value(fit, "lambda"), 0.1, 1e-6);
  EXPECT_NEAR(error(fit, "lambda"), 0.01, 1e-3);
}

TEST(Bootstrap, AgreesWithTheCovarianceOfACurveAndOfAMean) {
  RandomStream random(6, 0);
  ConsolidationOptions options;
  options.window = {0.03, 14.0};
  options.n_bootstrap = 400;
  const auto curve =
      with_relative_noise(curve_of(kSmallRolling.law(), published_pressures(0.0316)), 0.003, random);
  for (const ConsolidationCurve& c : {curve, mean_of_samples(12, random)}) {
    const auto fit = fit_consolidation(c, options);
    ASSERT_TRUE(fit.found()) << fit.failure_reason;
    EXPECT_EQ(fit.n_bootstrapped, 400);
    for (const FittedParameter& b : fit.bootstrap) {
      // The standard error from 400 draws is accurate to 3.5 %. The rest of the tolerance allows for the error
      // of the linearised covariance.
      EXPECT_NEAR(*b.standard_error / error(fit, b.name), 1.0, 0.25) << b.name;
      EXPECT_LT(*b.low95, value(fit, b.name)) << b.name;
      EXPECT_GT(*b.high95, value(fit, b.name)) << b.name;
    }
  }
}

TEST(RobustLoss, AnOutlierCountsForLittle) {
  RandomStream random(9, 0);
  auto curve = with_relative_noise(curve_of(kNoRolling.law(), published_pressures(0.0237)), 0.001, random);
  curve.phi[4] *= 1.1;
  ConsolidationOptions options;
  options.window = {0.02, 14.0};
  const double plain = value(fit_consolidation(curve, options), "lambda");
  EXPECT_GT(std::abs(plain / kNoRolling.lambda - 1), 0.05);
  for (const Loss loss : {Loss::huber, Loss::cauchy}) {
    options.loss = loss;
    const auto fit = fit_consolidation(curve, options);
    ASSERT_TRUE(fit.found()) << fit.failure_reason;
    EXPECT_NEAR(value(fit, "lambda"), kNoRolling.lambda, 4 * error(fit, "lambda"));
    EXPECT_LT(std::abs(value(fit, "lambda") / kNoRolling.lambda - 1),
              0.3 * std::abs(plain / kNoRolling.lambda - 1));
  }
}

}  // namespace
}  // namespace floc::test
