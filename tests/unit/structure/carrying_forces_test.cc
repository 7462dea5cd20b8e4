#include "floc/structure/carrying_forces.h"

#include <gtest/gtest.h>

#include <cmath>

#include "floc/packing/tile.h"
#include "support/crystals.h"

namespace floc {
namespace {

CarryingForces measured(const Packing<3>& packing, double smallest_force = 0.0, int least = 2) {
  return carrying_forces(packing, carrying_structure(packing, smallest_force, least));
}

TEST(CarryingForces, OfCrystalsAreAllAlikeAndIsotropic) {
  for (const test::CubicCrystal& crystal : test::cubic_crystals()) {
    const auto f = measured(test::crystal_of(crystal, 0.99, 1.0, test::elastic_law(1.0, 0.5, 0.0)));
    EXPECT_EQ(f.z, crystal.z);
    EXPECT_EQ(f.z_star, crystal.z);
    EXPECT_EQ(f.z_star_star.value(), crystal.z);
    EXPECT_EQ(f.x0, 0.0);
    EXPECT_NEAR(f.Z_third, 1.0, 1e-12);
    EXPECT_NEAR(f.Z_five_thirds, 1.0, 1e-12);
    EXPECT_LT(f.fabric.norm(), 1e-14) << crystal.name;
    EXPECT_EQ(f.M1 + f.M2 + f.sliding_share, 0.0);
  }
}

TEST(CarryingForces, CountRattlersAndGrainsOfTwoContacts) {
  // A simple cubic crystal of 27 spheres. The sphere in the middle keeps only its two contacts along x, and the
  // first sphere has no contacts.
  Packing<3> packing =
      tiled<3>(test::crystal_of(test::simple_cubic(), 0.99, 1.0, test::elastic_law(1.0, 0.5, 0.0)), {3, 3, 3});
  ASSERT_EQ(packing.contacts.size(), 81u);
  for (Contact<3>& c : packing.contacts) {
    if ((c.i == 13 || c.j == 13) && std::abs(c.normal[0]) < 0.5) c.normal_force = 1e-9;
    if (c.i == 0 || c.j == 0) c.normal_force = 0.0;
  }
  const auto f = measured(packing, 1e-6);
  EXPECT_EQ(f.n_contacts, 81 - 4 - 6);
  EXPECT_DOUBLE_EQ(f.z, 2.0 * 71 / 27);
  EXPECT_DOUBLE_EQ(f.x0, 1.0 / 27);
  EXPECT_DOUBLE_EQ(f.x2, 1.0 / 27);
  EXPECT_DOUBLE_EQ(f.z_star, 142.0 / 26);
  EXPECT_DOUBLE_EQ(f.z_star_star.value(), 142.0 / 26 + 2.0 / (3 * 26));
}

TEST(CarryingForces, HaveTheMomentsOfAHandfulOfContacts) {
  // Three contacts with the normal forces N = 1, 8 and 27, whose mean is <N> = 12. Their normals are along x, x and y,
  // and |T|/N = 0.5, 0.5 and 0.25. The last contact slides.
  Packing<3> packing;
  packing.grains = Grains<3>::with_size(3);
  for (int k = 0; k < 3; ++k) {
    Contact<3> c;
    c.i = k, c.j = (k + 1) % 3;
    c.normal = k < 2 ? Vec<3>::UnitX() : Vec<3>::UnitY();
    c.normal_force = c.elastic_force = std::pow(k + 1.0, 3);
    c.shear_force[2] = (k < 2 ? 0.5 : 0.25) * c.elastic_force;
    c.sliding = k == 2;
    packing.contacts.push_back(c);
  }
  const auto f = measured(packing);
  EXPECT_NEAR(f.Z_third, 2.0 / std::cbrt(12.0), 1e-14);
  EXPECT_NEAR(f.Z2, (1.0 + 64.0 + 729.0) / 3.0 / 144.0, 1e-14);
  EXPECT_NEAR(f.Z_five_thirds, (1.0 + 32.0 + 243.0) / 3.0 / std::pow(12.0, 5.0 / 3.0), 1e-14);
  EXPECT_DOUBLE_EQ(f.M1, 0.25);
  EXPECT_DOUBLE_EQ(f.M2, 0.5);
  EXPECT_DOUBLE_EQ(f.sliding_share, 1.0 / 3.0);
  EXPECT_NEAR(f.fabric(0, 0), 1.0 / 3.0, 1e-15);
  EXPECT_NEAR(f.fabric(1, 1), 0.0, 1e-15);
  EXPECT_NEAR(f.fabric(2, 2), -1.0 / 3.0, 1e-15);
  // Only the third contact has a normal force above <N>.
  EXPECT_NEAR(f.strong_fabric(0, 0), -1.0 / 9.0, 1e-15);
  EXPECT_NEAR(f.strong_fabric(1, 1), 2.0 / 9.0, 1e-15);
  EXPECT_NEAR(f.weak_fabric(0, 0), 4.0 / 9.0, 1e-15);
  EXPECT_LT((f.strong_fabric + f.weak_fabric - f.fabric).norm(), 1e-15);
}

TEST(CarryingForces, OfNothingAreZero) {
  Packing<3> packing;
  EXPECT_EQ(measured(packing).z, 0.0);
  packing.grains = Grains<3>::with_size(2);
  const auto f = measured(packing);
  EXPECT_EQ(f.x0, 1.0);
  EXPECT_EQ(f.z_star, 0.0);
  EXPECT_EQ(f.fabric.norm(), 0.0);
  EXPECT_EQ(f.strong_fabric.norm() + f.weak_fabric.norm(), 0.0);
}

}  // namespace
}  // namespace floc
