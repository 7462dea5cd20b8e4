#include "floc/fitting/modulus_law.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "floc/base/random.h"
#include "support/coverage.h"
#include "support/synthetic_soil.h"

namespace floc::test {
namespace {

using testing::HasSubstr;

/// Returns the moduli `coefficient * (x - start)^exponent`, with random relative errors.
std::vector<double> power_moduli(const std::vector<double>& x, double coefficient, double start,
                                 double exponent, double error, RandomStream& random) {
  std::vector<double> moduli;
  for (const double at : x)
    moduli.push_back(coefficient * std::pow(at - start, exponent) * std::exp(error * random.normal()));
  return moduli;
}

std::vector<double> even_fractions(double low, double high, int n) {
  std::vector<double> phi;
  for (int i = 0; i < n; ++i) phi.push_back(low + (high - low) * i / (n - 1.0));
  return phi;
}

TEST(ModulusLaw, ExactPowersGiveBackTheirParameters) {
  RandomStream unused(0, 0);
  const std::vector<double> P = geometric_pressures(0.01, 10.0, 12);
  const ModulusLaw of_pressure =
      fit_modulus_of_pressure(P, power_moduli(P, 310.0, 0.0, 1.0 / 3.0, 0.0, unused));
  ASSERT_TRUE(of_pressure.found()) << of_pressure.failure_reason;
  EXPECT_NEAR(*of_pressure.parameters[0].value, 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(*of_pressure.parameters[1].value, 310.0, 1e-9);
  for (const double exponent : {0.5, 1.1, 3.0}) {
    const std::vector<double> phi = even_fractions(0.66, 0.74, 15);
    const ModulusLaw law = fit_modulus_of_fraction(phi, power_moduli(phi, 800.0, 0.64, exponent, 0.0, unused));
    ASSERT_TRUE(law.found()) << law.failure_reason;
    EXPECT_NEAR(*law.parameters[0].value, exponent, 1e-6);
    EXPECT_EQ(law.parameters[1].name, "phi_0");
    EXPECT_NEAR(*law.parameters[1].value, 0.64, 1e-7);
    EXPECT_NEAR(*law.parameters[2].value, 800.0, 1e-3 * 800.0);
  }
}

TEST(ModulusLaw, IntervalsHoldTheTruth) {
  constexpr int kDraws = 200;
  RandomStream random(4, 0);
  Coverage of_pressure({{"exponent", 0.4}, {"coefficient", 310.0}});
  Coverage of_fraction({{"exponent", 1.2}, {"phi_0", 0.60}, {"coefficient", 800.0}});
  const std::vector<double> P = geometric_pressures(0.01, 10.0, 8), phi = even_fractions(0.61, 0.74, 12);
  for (int draw = 0; draw < kDraws; ++draw) {
    for (const FittedParameter& p :
         fit_modulus_of_pressure(P, power_moduli(P, 310.0, 0.0, 0.4, 0.05, random)).parameters)
      of_pressure.add(p);
    for (const FittedParameter& p :
         fit_modulus_of_fraction(phi, power_moduli(phi, 800.0, 0.60, 1.2, 0.03, random)).parameters)
      of_fraction.add(p);
  }
  of_pressure.expect_honest(kDraws, "modulus against the pressure");
  of_fraction.expect_honest(kDraws, "modulus against the solid fraction");
}

TEST(ModulusLaw, ThatTheStatesDoNotTellIsSaid) {
  RandomStream random(4, 0);
  EXPECT_THAT(fit_modulus_of_pressure({1, 2, 3}, {1, 2, 3}).failure_reason, HasSubstr("there are 3 states"));
  EXPECT_THAT(fit_modulus_of_pressure({2, 2, 2, 2}, {1, 2, 3, 4}).failure_reason,
              HasSubstr("all states have the same pressure"));
  EXPECT_THAT(fit_modulus_of_fraction({0.6, 0.61, 0.62, 0.63, 0.64, 0.65}, {9, 8, 7, 6, 5, 4}).failure_reason,
              HasSubstr("does not grow"));
  // The modulus vanishes at the solid fraction phi_0. Data far from phi_0 do not determine exponent and phi_0
  // separately.
  const std::vector<double> phi = even_fractions(0.70, 0.71, 8);
  const ModulusLaw law = fit_modulus_of_fraction(phi, power_moduli(phi, 800.0, 0.6, 1.2, 0.05, random));
  EXPECT_FALSE(law.parameters[1].identified);
  EXPECT_FALSE(law.parameters[1].value.has_value());
  EXPECT_FALSE(law.warnings.empty());
}

TEST(ModulusLaw, ThatIsNotThePowerIsDenied) {
  std::vector<double> moduli;
  const std::vector<double> P = geometric_pressures(0.01, 10.0, 20);
  for (const double p : P) moduli.push_back(100.0 + 50.0 * p);
  const ModulusLaw law = fit_modulus_of_pressure(P, moduli);
  EXPECT_TRUE(law.pattern.is_systematic());
  EXPECT_THAT(law.warnings, testing::ElementsAre(HasSubstr("does not follow this power law")));
}

}  // namespace
}  // namespace floc::test
