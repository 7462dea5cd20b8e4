#include "floc/packing/law/contact_forces.h"

#include <gtest/gtest.h>

#include "support/contact_laws.h"
#include "support/springs.h"

namespace floc {
namespace {

/// Disks of radii 1 and 0.5 with K_N = 100, F0 = 2 with a tail of 0.05, K_T = 80, mu = 0.5, K_R = 3 and mu_R = 0.1. The
/// second disk is at `distance` from the first, in the direction (0.6, 0.8). The line between them crosses the cell
/// boundary in x.
Packing<2> pair_at(double distance) {
  Packing<2> packing;
  packing.cell.matrix *= 10.0;
  packing.law += test::linear(100.0);
  packing.law += test::tail_adhesion(2.0, 0.05);
  packing.law += test::viscous_damping(0.1);
  packing.law += test::coulomb(0.5, 80.0);
  packing.law += test::rolling_spring(0.1, 3.0);
  packing.grains = Grains<2>::with_size(2);
  packing.grains.radius = {1.0, 0.5};
  packing.grains.mass = {1.0, 0.25};
  packing.grains.velocity[0] = {5.0, 5.0};
  packing.grains.position[0] = {9.5, 5.0};
  packing.grains.position[1] = Vec<2>(-0.5, 5.0) + distance * Vec<2>(0.6, 0.8);
  Contact<2> c;
  c.j = 1;
  c.image = {1, 0};
  test::shear_spring(c)[0] = 0.01;
  test::rolling_spring(c)[0] = -0.02;
  packing.contacts = {c};
  return packing;
}

TEST(RefreshContact, RecomputesForcesFromPositionsAndSprings) {
  Packing<2> packing = pair_at(1.4);
  refresh_contacts(packing);
  ASSERT_EQ(packing.contacts.size(), 1u);
  const Contact<2>& c = packing.contacts[0];
  // Positions near 10 have rounding errors of 2e-15; the errors of forces are K_N times as large.
  EXPECT_NEAR(c.gap, -0.1, 1e-14);
  EXPECT_NEAR((c.normal - Vec<2>(0.6, 0.8)).norm(), 0.0, 1e-14);
  EXPECT_NEAR(c.elastic_force, 10.0, 1e-12);
  EXPECT_NEAR(c.normal_force, 8.0, 1e-12);  // static force: the velocity of grain 0 does not change it
  EXPECT_NEAR((c.shear_force - 0.8 * Vec<2>(-0.8, 0.6)).norm(), 0.0, 1e-13);
  EXPECT_NEAR(c.rolling_moment[0], 0.06, 1e-15);
  EXPECT_EQ(c.kn, 100.0);
  EXPECT_EQ(c.kt, 80.0);
  EXPECT_EQ(c.kr, 3.0);
  EXPECT_FALSE(c.sliding);
  EXPECT_FALSE(c.rolling_yield);
  EXPECT_FALSE(c.distant);
}

TEST(RefreshContact, CutsSpringsBackToTheirCapsAndSaysSo) {
  Packing<2> packing = pair_at(1.4);
  test::shear_spring(packing.contacts[0])[0] = -1.0;
  test::rolling_spring(packing.contacts[0])[0] = 1.0;
  refresh_contacts(packing);
  const Contact<2>& c = packing.contacts[0];
  EXPECT_NEAR(test::shear_spring(c)[0], -0.5 * 10.0 / 80.0, 1e-14);
  EXPECT_NEAR(test::rolling_spring(c)[0], 0.1 * 10.0 / 3.0, 1e-13);
  EXPECT_NEAR(c.shear_force.norm(), 5.0, 1e-12);
  EXPECT_TRUE(c.sliding);
  EXPECT_TRUE(c.rolling_yield);
}

TEST(RefreshContact, AContactAtItsCapStaysAtItsCap) {
  Packing<2> packing = pair_at(1.4);
  test::shear_spring(packing.contacts[0])[0] = 1.0;
  refresh_contacts(packing);
  const double spring = test::shear_spring(packing.contacts[0])[0];
  refresh_contacts(packing);
  EXPECT_EQ(test::shear_spring(packing.contacts[0])[0], spring);
  EXPECT_TRUE(packing.contacts[0].sliding);
}

TEST(RefreshContact, AcrossTheTailOnlyAttracts) {
  Packing<2> packing = pair_at(1.525);
  refresh_contacts(packing);
  ASSERT_EQ(packing.contacts.size(), 1u);
  const Contact<2>& c = packing.contacts[0];
  EXPECT_NEAR(c.normal_force, -1.0, 1e-12);
  EXPECT_EQ(c.elastic_force, 0.0);
  EXPECT_DOUBLE_EQ(c.kn, -40.0);
  EXPECT_EQ(c.kt, 0.0);
  EXPECT_EQ(c.kr, 0.0);
  EXPECT_TRUE(c.distant);
  EXPECT_FALSE(c.sliding);
  EXPECT_EQ(test::shear_spring(c)[0], 0.0);
  EXPECT_EQ(test::rolling_spring(c)[0], 0.0);
}

TEST(RefreshContacts, DropsContactsBeyondTheRange) {
  Packing<2> packing = pair_at(1.551);
  refresh_contacts(packing);
  EXPECT_TRUE(packing.contacts.empty());
}

}  // namespace
}  // namespace floc
