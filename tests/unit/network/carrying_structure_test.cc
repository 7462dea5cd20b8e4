#include "floc/network/carrying_structure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/crystals.h"

namespace floc {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::SizeIs;

/// Contact with a given normal force between the grains i and j.
struct Bond {
  int i, j;
  double force;
};

Packing<3> bonded(int n, const std::vector<Bond>& bonds) {
  Packing<3> packing;
  packing.grains = Grains<3>::with_size(n);
  for (const auto& [i, j, force] : bonds) {
    Contact<3> c;
    c.i = i, c.j = j, c.normal_force = force;
    packing.contacts.push_back(c);
  }
  return packing;
}

TEST(CarryingStructure, LeavesOutWhatHangsOnWeakContacts) {
  // Grains 0 to 2 form a ring. Grain 3 is attached to the ring by a strong and a weak contact. Grain 4 is
  // attached to grain 3.
  const Packing<3> packing =
      bonded(5, {{0, 1, 1.0}, {1, 2, -1.0}, {0, 2, 1.0}, {2, 3, 1.0}, {1, 3, 1e-3}, {3, 4, 1.0}});
  const CarryingStructure held = carrying_structure(packing, 1e-2, 2);
  EXPECT_THAT(held.rattler, ElementsAre(false, false, false, true, true));
  EXPECT_THAT(held.contacts, ElementsAre(0, 1, 2));
  EXPECT_THAT(held.degree, ElementsAre(2, 2, 2, 0, 0));
  EXPECT_EQ(held.n_held(), 3);
  // With a lower threshold of force, the weak contact counts too, so that grain 3 has two contacts.
  EXPECT_THAT(carrying_structure(packing, 1e-4, 2).contacts, ElementsAre(0, 1, 2, 3, 4));
}

TEST(CarryingStructure, OfFewContactsIsNothingWithoutTangentialForces) {
  Packing<3> packing = bonded(3, {{0, 1, 1.0}, {1, 2, 1.0}, {0, 2, 1.0}});
  EXPECT_EQ(least_contacts(packing), 4);
  EXPECT_THAT(carrying_structure(packing, 0.0, least_contacts(packing)).rattler, Each(true));
  packing.contacts[1].shear_force = {0.0, 1e-3, 0.0};
  EXPECT_EQ(least_contacts(packing), 2);
  EXPECT_THAT(carrying_structure(packing, 0.0, least_contacts(packing)).rattler, Each(false));
}

TEST(CarryingStructure, OfACrystalIsAllOfIt) {
  for (const test::CubicCrystal& crystal : test::cubic_crystals()) {
    const Packing<3> packing = test::crystal_of(crystal, 0.99, 1.0, test::elastic_law(1.0, 0.5, 0.0));
    const CarryingStructure held = carrying_structure(packing, 1e-3, 4);
    EXPECT_EQ(held.n_rattlers, 0) << crystal.name;
    EXPECT_THAT(held.degree, Each(crystal.z));
    EXPECT_THAT(carrying_network(packing, held).contacts, SizeIs(packing.contacts.size()));
    EXPECT_THAT(carrying_structure(packing, 0.02, 4).contacts, SizeIs(0));
  }
}

}  // namespace
}  // namespace floc
