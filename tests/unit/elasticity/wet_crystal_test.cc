#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floc/elasticity/moduli.h"
#include "floc/elasticity/stability.h"
#include "floc/packing/balance.h"
#include "support/contact_laws.h"
#include "support/crystals.h"

namespace floc {
namespace {

/// Law with liquid bridges. Between spheres of diameter one, the strength of a bridge is Gamma R = 1.
Law wet_law(double water) {
  Law law = test::elastic_law(1e4, 0.7e4, 0.0);
  law += test::liquid(1.0 / std::numbers::pi, 0.0, water, 2.5);
  return law;
}

ModuliOptions of_all_strains() {
  ModuliOptions options;
  options.strains = StrainSet::full;
  return options;
}

TEST(WetCrystal, AtRestHasTheModuliOfTheDryOne) {
  const double distance = 1.0 - 1e-4;  // distance at equilibrium: the overlap is Gamma R/K_N = 1e-4
  const Packing<3> wet = test::crystal_of(test::simple_cubic(), distance, 1.0, wet_law(2e-3));
  const Packing<3> dry = test::crystal_of(test::simple_cubic(), distance, 1.0, wet_law(0.0));
  EXPECT_NEAR(static_stress(wet).trace(), 0.0, 1e-10);
  const Eigen::MatrixXd expected = elastic_moduli(dry, of_all_strains()).C;
  EXPECT_LT((elastic_moduli(wet, of_all_strains()).C - expected).cwiseAbs().maxCoeff(), 1e-12 * expected(0, 0));
  EXPECT_EQ(stability(wet).n_negative, 0);
}

TEST(WetCrystal, HeldByBridgesAloneIsSaidToBeUnstable) {
  const double h = 0.02;
  const Packing<3> apart = test::crystal_of(test::simple_cubic(), 1.0 + h, 1.0, wet_law(2e-3));
  ASSERT_EQ(apart.contacts.size(), 3u);
  const Moduli m = elastic_moduli(apart, of_all_strains());
  const double slope = -apart.contacts[0].kn;
  EXPECT_GT(slope, 0.0);
  EXPECT_NEAR(m.C(0, 0), -slope / (1.0 + h), 1e-10 * slope);
  EXPECT_GT(m.n_negative, 0);
  EXPECT_TRUE(std::any_of(m.warnings.begin(), m.warnings.end(), [](const std::string& words) {
    return words.find("unstable") != std::string::npos;
  }));
  EXPECT_GT(stability(apart).n_negative.value(), 0);
}

}  // namespace
}  // namespace floc
