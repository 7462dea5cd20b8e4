#include <gtest/gtest.h>

#include <cmath>

#include "support/published_consolidation.h"

namespace floc::test {
namespace {

TEST(ConsolidationRecovery, TwoThousandRandomSetsFromTheAutomaticStart) {
  RandomStream random(7, 0);
  constexpr double kP0 = 0.02;
  for (int k = 0; k < 2000; ++k) {
    const ConsolidationLawParameters law{random.uniform(0.02, 0.6), random.uniform(0.4, 2.5),
                                         1 / (1 + random.uniform(0.05, 1.0)),
                                         kP0 * std::exp(random.uniform(std::log(3.0), std::log(1000.0)))};
    std::vector<double> pressures;
    for (double P = kP0; P < 10.0001 * law.P1_star; P *= std::pow(10.0, 1 / 8.0)) pressures.push_back(P);
    const auto fit = fit_consolidation(curve_of(law, pressures), {});
    ASSERT_TRUE(fit.found()) << k << ": " << fit.failure_reason;
    const auto expect = [&](const char* name, double truth) {
      const FittedParameter* p = fit.find(name);
      ASSERT_TRUE(p && p->value) << k << ": " << name;
      EXPECT_NEAR(*p->value / truth, 1.0, 1e-8) << k << ": " << name;
    };
    expect("lambda", law.lambda);
    expect("alpha", law.alpha);
    expect("Phi_max", law.phi_max);
    expect("P1_star", law.P1_star);
    EXPECT_NEAR(std::log(law.P1_star / kP0),
                (1 / *fit.find("Phi0")->value - 1 / *fit.find("Phi_max")->value) / *fit.find("lambda")->value,
                1e-8);
  }
}

}  // namespace
}  // namespace floc::test
