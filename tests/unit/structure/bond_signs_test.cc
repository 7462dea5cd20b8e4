#include "floc/structure/bond_signs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "floc/packing/balance.h"
#include "support/crystals.h"

namespace floc::test {
namespace {

TEST(BondSigns, AreCountedWithAClassNearZero) {
  Packing<2> packing;
  packing.grains = Grains<2>::with_size(4);
  packing.walls.resize(2);
  const auto bond = [&](int j, double force, bool distant) {
    Contact<2> c;
    c.j = j;
    c.normal_force = force;
    c.distant = distant;
    packing.contacts.push_back(c);
  };
  bond(1, 2.0, false);
  bond(1, 4.0, false);
  bond(2, -1.0, false);
  bond(2, -3.0, true);
  bond(3, 0.019, false);
  bond(3, -0.019, true);
  bond(3, 0.0, false);
  bond(4, 5.0, false);  // contact with a wall, which is not counted
  const BondSigns bonds = bond_signs(packing, 0.02);
  EXPECT_EQ(bonds.n_bonds, 7);
  EXPECT_DOUBLE_EQ(bonds.z, 3.5);
  EXPECT_DOUBLE_EQ(bonds.z_plus, 1.0);
  EXPECT_DOUBLE_EQ(bonds.z_minus, 1.0);
  EXPECT_DOUBLE_EQ(bonds.z_near, 1.5);
  EXPECT_DOUBLE_EQ(bonds.minus_share, 0.5);
  EXPECT_DOUBLE_EQ(bonds.mean_plus, 3.0);
  EXPECT_DOUBLE_EQ(bonds.mean_minus, 2.0);
  // If the threshold is zero, only bonds with zero force count as near zero.
  EXPECT_DOUBLE_EQ(bond_signs(packing, 0.0).z_near, 0.5);
}

TEST(Strength, OfCrystalsIsTheirStressAtThePullOffForce) {
  constexpr double kF0 = 0.7, kDiameter = 1.0;
  for (const CubicCrystal& crystal : cubic_crystals()) {
    Packing<3> packing = crystal_of(crystal, (1.0 - 1e-12) * kDiameter, kDiameter, elastic_law(1.0, 0.0, 0.0));
    for (Contact<3>& c : packing.contacts) c.normal_force = -kF0;
    const double stress = static_stress(packing).trace() / 3.0;
    EXPECT_NEAR(virial_strength(3, crystal.z, solid_fraction(packing), kF0, kDiameter), -stress, 1e-10)
        << crystal.name;
  }
  // A simple cubic crystal separates at the stress F0/d^2.
  EXPECT_NEAR(virial_strength(3, 6, std::acos(-1.0) / 6.0, 0.7, 2.0), 0.7 / 4.0, 1e-15);
  EXPECT_NEAR(virial_strength(2, 4, std::acos(-1.0) / 4.0, 0.7, 2.0), 0.7 / 2.0, 1e-15);
  EXPECT_DOUBLE_EQ(rumpf_strength(3, 0.6, 0.7, 2.0), 1.5 * 0.7 / 4.0);
}

}  // namespace
}  // namespace floc::test
