#include "floc/elasticity/moduli.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "floc/elasticity/stability.h"
#include "support/contact_laws.h"
#include "support/lattices.h"

namespace floc {
namespace {

TEST(Moduli, RollingStiffnessIsReplacedInEveryTouchingContact) {
  const Packing<2> soft = test::square_frames(4, 1.0, test::elastic_law(1.0, 0.7, 0.01));
  const Packing<2> stiff = test::square_frames(4, 1.0, test::elastic_law(1.0, 0.7, 0.2));
  ModuliOptions options;
  options.strains = StrainSet::full;
  const Eigen::MatrixXd expected = elastic_moduli(stiff, options).C;
  options.rolling_stiffness = 0.2;
  // The two results are equal bit for bit, because they are the same sums of the same numbers.
  EXPECT_EQ((elastic_moduli(soft, options).C - expected).cwiseAbs().maxCoeff(), 0.0);
}

TEST(Moduli, OfSeveralRollingStiffnessesAreThoseOfEachAlone) {
  const Packing<2> packing = test::square_frames(4, 1.0, test::elastic_law(1.0, 0.7, 0.01));
  const std::vector<double> rolling{1e-2, 0.0, 1e-4, 1.0};
  const std::vector<Moduli> all = elastic_moduli(packing, {}, rolling);
  ASSERT_EQ(all.size(), rolling.size());
  for (std::size_t k = 0; k < rolling.size(); ++k) {
    ModuliOptions options;
    options.rolling_stiffness = rolling[k];
    // The two results are equal bit for bit, because they are the same sums of the same numbers.
    EXPECT_EQ((all[k].C - elastic_moduli(packing, options).C).cwiseAbs().maxCoeff(), 0.0) << rolling[k];
  }
}

TEST(Moduli, TellWhatRoundingLeavesOfThem) {
  const Packing<2> packing = test::square_frames(4, 1.0, test::elastic_law(1.0, 0.7, 0.01));
  const Moduli m = elastic_moduli(packing, {});
  for (const double relative : {m.B_error / m.B, m.B_S_error / m.B_S, m.G_error / m.G}) {
    EXPECT_GT(relative, 0.0);
    EXPECT_LT(relative, 1e-12);
  }
  EXPECT_TRUE(m.warnings.empty());
  ModuliOptions options;
  options.tolerance = 1e-20;
  const Moduli strict = elastic_moduli(packing, options);
  ASSERT_EQ(strict.warnings.size(), 1u);
  EXPECT_NE(strict.warnings[0].find("above the tolerance of 1.0e-20"), std::string::npos);
}

TEST(Moduli, OfAPackingUnderNoStressAreNotBoundedByWhatItsForcesLeaveOfOne) {
  Packing<2> packing = test::square_frames(3, 1.0, test::elastic_law(1.0, 0.7, 0.01));
  for (Contact<2>& c : packing.contacts) c.normal_force = 1e-6;
  ModuliOptions options;
  EXPECT_GT(elastic_moduli(packing, options).bounds.B_reuss, 0.0);
  options.unloaded = true;
  EXPECT_EQ(elastic_moduli(packing, options).bounds.B_reuss, 0.0);
}

TEST(Moduli, CountContactsAtTheirCap) {
  Packing<2> packing = test::square_frames(3, 1.0, test::elastic_law(1.0, 0.7, 0.01));
  packing.contacts[0].sliding = true;
  packing.contacts[1].rolling_yield = true;
  const Moduli m = elastic_moduli(packing, {});
  EXPECT_EQ(m.n_mobilised, 2);
  EXPECT_EQ(m.warnings.size(), 1u);
}

TEST(Moduli, OptionsSayEveryFault) {
  ModuliOptions options;
  options.force_tolerance = -1.0;
  options.rolling_stiffness = std::numeric_limits<double>::quiet_NaN();
  options.tolerance = 0.0;
  EXPECT_EQ(options.validate().size(), 3u);
  EXPECT_TRUE(ModuliOptions{}.validate().empty());
}

TEST(Moduli, OfAPackingWithoutContactsAreZero) {
  Packing<2> packing = test::square_frames(2, 1.0, test::elastic_law(1.0, 0.7, 0.01));
  packing.contacts.clear();
  const Moduli m = elastic_moduli(packing, {});
  EXPECT_EQ(m.C.cwiseAbs().maxCoeff(), 0.0);
  EXPECT_EQ(m.B_S, 0.0);
  EXPECT_TRUE(std::isinf(m.bounds.Z2));
  EXPECT_EQ(m.n_rattlers, 1);
  EXPECT_EQ(m.n_coupled_mechanisms, 2);
}

TEST(Moduli, ShearOfAnIsotropicNetworkIsReadAlikeFromEitherKindOfStrain) {
  Packing<2> packing = test::triangular(1.0, test::elastic_law(1.0, 0.7, 0.01));
  ModuliOptions options;
  options.strains = StrainSet::full;
  options.prestress = true;
  const Moduli m = elastic_moduli(packing, options);
  // Prestress does not destroy the isotropy of an isotropic lattice, except for the rounding of a few sums.
  EXPECT_NEAR(m.G, m.C(2, 2), 1e-13);
  EXPECT_NE(m.G, *m.G_without_prestress);
}

TEST(Bounds, ReussVanishesWhereForcesCancelInThePressure) {
  Packing<2> packing = test::square_frames(2, 1.0, test::elastic_law(1.0, 0.7, 0.01));
  packing.contacts[0].normal_force = 1.0;
  packing.contacts[1].normal_force = -1.0 + 1e-15;
  EXPECT_EQ(elastic_moduli(packing, {}).bounds.B_reuss, 0.0);
  packing.contacts[1].normal_force = -1.0 + 1e-3;
  EXPECT_GT(elastic_moduli(packing, {}).bounds.B_reuss, 0.0);
}

TEST(Stability, OfALineOfDistantBondsIsLost) {
  // A chain along x. Each disk also attracts its own images along y, across a gap. The contacts of the chain do not
  // resist a strain along y.
  Law law = test::elastic_law(1.0, 0.7, 0.1);
  law += test::tail_adhesion(0.02, 0.1);
  Packing<2> packing = test::chain_across(3, 1.0, 1.05, law);
  const auto distant = [](const Contact<2>& c) { return c.distant; };
  ASSERT_EQ(std::count_if(packing.contacts.begin(), packing.contacts.end(), distant), 3);
  // Only the attractions contribute to the modulus along y, with a negative stiffness.
  EXPECT_EQ(stability(packing).n_negative, 1);
  std::erase_if(packing.contacts, distant);
  EXPECT_EQ(stability(packing).n_negative, 0);
}

}  // namespace
}  // namespace floc
