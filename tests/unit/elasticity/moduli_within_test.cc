#include "floc/elasticity/moduli_within.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/lattices.h"
#include "support/network_packings.h"

namespace floc {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double kAny = std::numeric_limits<double>::infinity();

void expect_accuracy_met(const Moduli& m, const Moduli& exact, const ModuliAccuracy& accuracy) {
  EXPECT_TRUE(accuracy.met_by(m));
  EXPECT_LE(std::abs(m.B - exact.B), accuracy.B * exact.B + exact.B_error);
  EXPECT_LE(std::abs(m.G - exact.G), accuracy.G * exact.G + exact.G_error);
}

/// In a triangular lattice with equal forces the displacements are affine, so both bounds equal the modulus,
/// sqrt(3)/2 K_N.
TEST(ModuliWithin, TakeTheBoundsWhereTheyMeet) {
  const Packing<2> crystal = test::triangular(0.999, test::elastic_law(1.0, 0.7, 0.0));
  const ModuliAccuracy accuracy{1e-6, kAny};
  const Moduli m = moduli_within(crystal, {}, accuracy);
  EXPECT_EQ(m.method, ModuliMethod::bounds);
  EXPECT_NEAR(m.B, std::sqrt(0.75), 1e-6 * std::sqrt(0.75));
  expect_accuracy_met(m, elastic_moduli(crystal, {}), accuracy);
}

/// Square frames with two small disks between neighbouring large disks. All overlaps, and therefore all forces, are
/// equal. This is also the case in the response to an isotropic stress, so B_reuss = B. B_voigt is larger than B by the
/// factor 3 (1 + 0.4^2 + 1)/2.4^2 = 9/8, because an affine strain stretches long branches more.
Packing<2> uneven_frames() {
  Packing<2> packing = test::square_frames(4, 1.0, test::elastic_law(1.0, 0.7, 0.05));
  const double overlap = 1e-4, along[] = {0.0, 1.0, 1.4};
  packing.cell.matrix = 2.4 * Mat<2>::Identity();
  packing.grains.radius.assign(5, 0.2 + 0.5 * overlap);
  packing.grains.radius[0] = 0.8 + 0.5 * overlap;
  for (int k = 1; k < 3; ++k) {
    packing.grains.position[2 * k - 1] = {along[k], 0.0};
    packing.grains.position[2 * k] = {0.0, along[k]};
  }
  find_contacts(packing);
  return packing;
}

TEST(ModuliWithin, FallBackFromBoundsThatAreTooFarApart) {
  const Packing<2> packing = uneven_frames();
  const Moduli exact = elastic_moduli(packing, {});
  ASSERT_NEAR(exact.bounds.B_voigt / exact.B, 1.125, 1e-12);
  ASSERT_NEAR(exact.bounds.B_reuss / exact.B, 1.0, 1e-12);
  for (const double asked : {0.07, 0.05, 1e-3, 1e-6}) {
    const ModuliAccuracy accuracy{asked, kAny};
    const Moduli m = moduli_within(packing, {}, accuracy);
    EXPECT_EQ(m.method, asked > 0.0625 ? ModuliMethod::bounds : ModuliMethod::single_factor) << asked;
    expect_accuracy_met(m, exact, accuracy);
  }
}

/// The only bounds of G are 0 and G_voigt. A value halfway between them may be wrong by 100 %, so G has to be computed
/// from the factorization.
TEST(ModuliWithin, SolveForAShearModulus) {
  const Packing<2> packing = test::random_packing<2>(100, 7, test::elastic_law(1.0, 0.8, 0.01));
  for (const ModuliAccuracy& accuracy : {ModuliAccuracy{kAny, 0.9}, ModuliAccuracy{0.9, 0.9}}) {
    const Moduli m = moduli_within(packing, {}, accuracy);
    EXPECT_EQ(m.method, ModuliMethod::single_factor);
    expect_accuracy_met(m, elastic_moduli(packing, {}), accuracy);
  }
}

/// The bounds B_reuss <= B <= B_voigt hold only without prestress, without attractions at a distance and with equal
/// principal stresses. There are no such bounds for single entries of C.
TEST(ModuliWithin, TrustBoundsOnlyWhereTheyAreSome) {
  const Packing<2> crystal = test::triangular(0.999, test::elastic_law(1.0, 0.7, 0.0));
  const ModuliAccuracy accuracy{0.5, kAny};
  ASSERT_EQ(moduli_within(crystal, {}, accuracy).method, ModuliMethod::bounds);
  ModuliOptions prestress, full;
  prestress.prestress = true;
  full.strains = StrainSet::full;
  EXPECT_NE(moduli_within(crystal, prestress, accuracy).method, ModuliMethod::bounds);
  EXPECT_NE(moduli_within(crystal, full, accuracy).method, ModuliMethod::bounds);
  Packing<2> squeezed = crystal;
  squeezed.cell.matrix.col(0) *= 0.999;
  find_contacts(squeezed);
  EXPECT_NE(moduli_within(squeezed, {}, accuracy).method, ModuliMethod::bounds);
  Packing<2> pulled = crystal;
  pulled.contacts[0].distant = true;
  EXPECT_NE(moduli_within(pulled, {}, accuracy).method, ModuliMethod::bounds);
}

/// If a mechanism makes a modulus zero, the modulus has no relative accuracy. Only the factorization detects
/// mechanisms.
TEST(ModuliWithin, LeaveMechanismsToTheFactor) {
  const Packing<2> chain = test::chain_across(10, 0.999, 2.0, test::elastic_law(1.0, 0.7, 0.03));
  const Moduli m = moduli_within(chain, {}, {1e-6, 1e-6});
  EXPECT_EQ(m.method, ModuliMethod::factor);
  EXPECT_EQ(m.n_coupled_mechanisms, 1);
  EXPECT_TRUE((ModuliAccuracy{1e-6, 1e-6}.met_by(m)));
}

TEST(ModuliWithin, GiveTheFactorWhereNothingIsEnoughAndTellSo) {
  const Packing<2> packing = test::random_packing<2>(200, 3, test::elastic_law(1.0, 0.8, 1e-9));
  const ModuliAccuracy accuracy{1e-14, 1e-14};
  const Moduli m = moduli_within(packing, {}, accuracy);
  EXPECT_EQ(m.method, ModuliMethod::factor);
  EXPECT_FALSE(accuracy.met_by(m));
  EXPECT_THAT(m.warnings, ::testing::Contains(HasSubstr("above the tolerance of 1.0e-14")));
}

/// The accuracy is relative to the exact modulus, which may be smaller than the computed one.
TEST(ModuliWithin, MeanErrorsRelativeToTheModulusItself) {
  Moduli m;
  m.B = 3.0;
  m.B_error = 1.0;  // the exact B may be 2; the computed value 3 differs from 2 by 50 %
  EXPECT_TRUE((ModuliAccuracy{0.5, kAny}.met_by(m)));
  EXPECT_FALSE((ModuliAccuracy{0.49, kAny}.met_by(m)));
  m.B_error = kAny;
  EXPECT_FALSE((ModuliAccuracy{0.5, kAny}.met_by(m)));
  m.B = m.B_error = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE((ModuliAccuracy{0.5, kAny}.met_by(m)));
}

TEST(ModuliAccuracy, RefusesWhatRoundingLeavesAndNothingAtAll) {
  EXPECT_THAT((ModuliAccuracy{1e-15, kAny}.validate()),
              ElementsAre("accuracy of B = 1e-15: must be at least 1e-14, the rounding error"));
  EXPECT_THAT((ModuliAccuracy{kAny, -1.0}.validate()), ElementsAre(HasSubstr("accuracy of G = -1: must be")));
  EXPECT_THAT(ModuliAccuracy{}.validate(),
              ElementsAre("accuracy: at least one of the accuracies of B and G must be finite"));
  EXPECT_TRUE((ModuliAccuracy{1e-14, kAny}.validate().empty()));
}

}  // namespace
}  // namespace floc
