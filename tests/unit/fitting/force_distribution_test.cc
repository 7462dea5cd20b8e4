#include "floc/fitting/force_distribution.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace floc {
namespace {

using testing::HasSubstr;

const std::vector<const ForceLaw*> kLaws = {&power_exponential(), &quadratic_exponential()};

/// Returns several values within the range of the parameter of a law.
std::vector<double> parameters_of(const ForceLaw& law) {
  return &law == kLaws[0] ? std::vector<double>{-0.8, 0.0, 0.3, 0.7} : std::vector<double>{0.7, 1.0, 1.4, 2.0};
}

/// Integrates f^power P(f). The integrand is singular at 0, so the midpoint rule is applied after the substitution f =
/// t^4.
double moment(const ForceLaw& law, double parameter, int power) {
  constexpr int kSteps = 400000;
  const double end = std::pow(80.0, 0.25);
  const double step = end / kSteps;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double t = (i + 0.5) * step;
    const double f = std::pow(t, 4);
    sum += std::pow(f, power) * std::exp(law.log_density(parameter, f)) * 4 * std::pow(t, 3) * step;
  }
  return sum;
}

TEST(ForceLaws, NormAndMeanAreOne) {
  for (const ForceLaw* law : kLaws)
    for (const double x : parameters_of(*law)) {
      // The midpoint rule is of second order in its step, which is 2.5e-6 of the range of t.
      EXPECT_NEAR(moment(*law, x, 0), 1.0, 1e-6) << law->name << ' ' << x;
      EXPECT_NEAR(moment(*law, x, 1), 1.0, 1e-6) << law->name << ' ' << x;
    }
}

TEST(ForceLaws, CumulativeIsTheIntegralOfTheDensity) {
  for (const ForceLaw* law : kLaws)
    for (const double x : parameters_of(*law)) {
      for (const double f : {0.1, 0.5, 0.99, 1.01, 2.0, 5.0}) {
        const double h = 1e-5 * f;
        const double slope = (law->cumulative(x, f + h) - law->cumulative(x, f - h)) / (2 * h);
        EXPECT_NEAR(slope, std::exp(law->log_density(x, f)), 1e-6) << law->name << ' ' << x << ' ' << f;
      }
      EXPECT_NEAR(law->cumulative(x, 0.0), 0.0, 1e-15);
      EXPECT_NEAR(law->cumulative(x, 60.0), 1.0, 1e-12);
    }
}

TEST(ForceLaws, PowerAndExponentialMeetAtTheMean) {
  const ForceLaw& law = power_exponential();
  EXPECT_NEAR(law.log_density(0.3, 1 - 1e-12), law.log_density(0.3, 1.0), 1e-10);
  // Beyond the mean force, ln P(f) falls with the slope -beta, with beta^2 = (1 - alpha)(2 - alpha).
  EXPECT_NEAR(law.log_density(0.3, 2.0) - law.log_density(0.3, 3.0), std::sqrt(0.7 * 1.7), 1e-12);
}

TEST(CompressiveForces, LikelihoodRecoversTheParameterThatDrewThem) {
  for (const ForceLaw* law : kLaws)
    for (const double x : parameters_of(*law)) {
      RandomStream random(4, 0);
      std::vector<double> forces(20000);
      for (double& f : forces) f = 3.7 * law->draw(x, random);
      ForceFitOptions options;
      options.n_draws = 2;
      const ForceFit fit = fit_compressive_forces(*law, forces, options);
      ASSERT_TRUE(fit.found()) << fit.failure_reason;
      const FittedParameter& p = fit.parameters[0];
      EXPECT_NEAR(*p.value, x, 4 * *p.standard_error) << law->name;
      EXPECT_LT(*p.standard_error, 0.05);
      EXPECT_NEAR(fit.mean, 3.7, 0.1);
      // In the Kolmogorov test, the distance of the two distributions exceeds 1.63/sqrt(n) with probability 0.01. The
      // probability is smaller if a parameter is fitted, as here.
      EXPECT_LT(fit.distance, 1.63 / std::sqrt(20000.0)) << law->name << ' ' << x;
    }
}

TEST(CompressiveForces, TheWrongFormIsRejectedTheRightOneNot) {
  RandomStream random(5, 0);
  std::vector<double> forces(1500);
  for (double& f : forces) f = power_exponential().draw(0.7, random);
  const ForceFit right = fit_compressive_forces(power_exponential(), forces, {});
  const ForceFit wrong = fit_compressive_forces(quadratic_exponential(), forces, {});
  EXPECT_GT(right.p_value, 0.05);
  EXPECT_LT(wrong.p_value, 0.01);
  EXPECT_GT(right.log_likelihood, wrong.log_likelihood);
}

TEST(ExponentialTail, IsTheMeanExcessWithItsError) {
  RandomStream random(6, 0);
  constexpr int kRepeats = 200;
  int covered = 0, rejected = 0;
  ForceFitOptions options;
  options.n_draws = 60;
  for (int r = 0; r < kRepeats; ++r) {
    std::vector<double> forces(60);
    for (double& f : forces) f = 1.0 - 2.5 * std::log(1 - random.uniform());
    const ForceFit fit = fit_exponential_tail("tail_positive", forces, 1.0, options);
    covered += *fit.parameters[0].low95 <= 2.5 && 2.5 <= *fit.parameters[0].high95;
    rejected += fit.p_value < 0.05;
  }
  // If each interval contains the true value with probability 0.95, then between 180 and 198 of 200 intervals contain
  // it, with probability 0.995. A correct law is rejected in 10 +- 3 of 200 fits.
  EXPECT_GE(covered, 180);
  EXPECT_LE(covered, 198);
  EXPECT_LE(rejected, 20);
}

TEST(ForceFits, TooFewForcesAreRefused) {
  EXPECT_THAT(fit_compressive_forces(power_exponential(), {1, 2, 3}, {}).failure_reason,
              HasSubstr("3 forces > 0"));
  EXPECT_THAT(fit_exponential_tail("tail_negative", {1, 2, 3}, 2, {}).failure_reason,
              HasSubstr("1 forces beyond"));
}

}  // namespace
}  // namespace floc
