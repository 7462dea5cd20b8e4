#include "floc/fitting/preconsolidation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "floc/base/random.h"

namespace floc {
namespace {

using testing::HasSubstr;

constexpr double kKappa = 0.02, kLambda = 0.2, kPc = 1.7;

struct Branch {
  std::vector<double> P, phi;
};

Branch bent(double noise, int n_decade, RandomStream& random) {
  Branch branch;
  for (double P = 0.1; P < 20; P *= std::pow(10.0, 1.0 / n_decade)) {
    const double x = std::log(P / kPc);
    branch.P.push_back(P);
    branch.phi.push_back(1 / (1.6 - (x < 0 ? kKappa : kLambda) * x + noise * random.normal()));
  }
  return branch;
}

double value(const PreconsolidationFit& fit, std::size_t k) {
  return *fit.parameters[k].value;
}

TEST(Preconsolidation, IsFoundBetweenTheRows) {
  RandomStream random(1, 0);
  const Branch branch = bent(0.0, 8, random);
  const auto fit = fit_preconsolidation(branch.P, branch.phi);
  ASSERT_TRUE(fit.found()) << fit.failure_reason;
  // The bend is searched on a grid of 4000 points over five units of ln P.
  EXPECT_NEAR(value(fit, 0), kPc, 2e-3 * kPc);
  EXPECT_NEAR(value(fit, 1), kKappa, 1e-3);
  EXPECT_NEAR(value(fit, 2), kLambda, 1e-3);
}

TEST(Preconsolidation, IntervalsCoverTheTruth) {
  constexpr int kRepeats = 60;
  const double truth[3] = {kPc, kKappa, kLambda};
  // The positions of the bend are tried on a grid. Data without much noise determine the bend far within a grid step.
  for (const double noise : {2e-3, 5e-4, 1e-4, 1e-5}) {
    SCOPED_TRACE(testing::Message() << "noise " << noise);
    RandomStream random(2, 0);
    int covered[3] = {0, 0, 0};
    for (int k = 0; k < kRepeats; ++k) {
      const Branch branch = bent(noise, 6, random);
      const auto fit = fit_preconsolidation(branch.P, branch.phi);
      ASSERT_TRUE(fit.found()) << fit.failure_reason;
      for (std::size_t i = 0; i < 3; ++i) {
        const FittedParameter& p = fit.parameters[i];
        covered[i] += p.low95.value_or(0.0) <= truth[i] && truth[i] <= p.high95.value_or(1e9);
        EXPECT_LT(p.low95.value_or(0.0), *p.value);
        EXPECT_GT(p.high95.value_or(1e9), *p.value);
      }
    }
    // If each interval contains the truth with probability 0.95, the probability is 1/500 that fewer than 52 of
    // 60 contain it.
    for (const int count : covered) EXPECT_GE(count, 52);
  }
}

TEST(Preconsolidation, WithoutABendIsRefused) {
  Branch straight;
  for (double P = 0.1; P < 2; P *= 1.3) {
    straight.P.push_back(P);
    straight.phi.push_back(1 / (1.6 - 0.05 * std::log(P)));
  }
  EXPECT_THAT(fit_preconsolidation(straight.P, straight.phi).failure_reason, HasSubstr("does not bend"));
  EXPECT_THAT(fit_preconsolidation({1, 2, 3}, {0.5, 0.6, 0.7}).failure_reason, HasSubstr("3 pressures"));
}

}  // namespace
}  // namespace floc
