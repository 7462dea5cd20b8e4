#include "floc/structure/coordination.h"

#include <gtest/gtest.h>

#include "support/contact_laws.h"

namespace floc {
namespace {

TEST(Coordination, CountsContactsBySignAndDistantOnesApart) {
  Packing<2> packing;
  packing.law += test::linear(1.0);
  packing.law += test::tail_adhesion(1.0, 0.1);
  packing.grains = Grains<2>::with_size(5);
  const auto contact = [](int i, int j, double force, bool distant) {
    Contact<2> c;
    c.i = i, c.j = j, c.normal_force = force, c.distant = distant;
    return c;
  };
  packing.contacts = {contact(0, 1, 2.0, false), contact(0, 2, -1.0, false), contact(1, 2, 1e-9, false),
                      contact(1, 3, -0.5, true)};
  const Coordination c = coordination(packing, 1e-6);
  EXPECT_EQ(c.n_contacts, 3);
  EXPECT_EQ(c.n_distant, 1);
  EXPECT_DOUBLE_EQ(c.z, 6.0 / 5.0);
  EXPECT_DOUBLE_EQ(c.z_plus, 2.0 / 5.0);
  EXPECT_DOUBLE_EQ(c.z_minus, 2.0 / 5.0);
  EXPECT_DOUBLE_EQ(c.z_zero, 2.0 / 5.0);
  EXPECT_DOUBLE_EQ(c.rattler_fraction, 1.0 / 5.0);  // only grain 4; an attraction holds grain 3
}

TEST(Coordination, LeavesRattlersOutAndCountsPairsOfTwo) {
  // Grains 0 to 3 form a ring, grain 4 is attached to grain 0, and grain 5 is alone. The contacts are 01, 12, 23, 30
  // and 04.
  Packing<2> packing;
  packing.law += test::linear(1.0);
  packing.law += test::tail_adhesion(1.0, 0.1);
  packing.grains = Grains<2>::with_size(6);
  for (const auto& [i, j] : {std::pair{0, 1}, {1, 2}, {2, 3}, {0, 3}, {0, 4}}) {
    Contact<2> c;
    c.i = i, c.j = j, c.normal_force = 1.0;
    packing.contacts.push_back(c);
  }
  const Coordination c = coordination(packing, 0.0);
  EXPECT_EQ(c.n_rattlers, 1);
  EXPECT_DOUBLE_EQ(c.z_star, 10.0 / 5.0);
  EXPECT_DOUBLE_EQ(c.x22, 2.0 / 5.0);  // contacts 12 and 23
  // Without adhesion, grain 4 is a rattler too. Its contact does not count in z*.
  packing.law += test::without("adhesion");
  const Coordination bare = coordination(packing, 0.0);
  EXPECT_EQ(bare.n_rattlers, 2);
  EXPECT_DOUBLE_EQ(bare.z_star, 8.0 / 4.0);
}

}  // namespace
}  // namespace floc
