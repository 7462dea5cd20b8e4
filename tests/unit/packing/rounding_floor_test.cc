#include "floc/packing/rounding_floor.h"

#include <gtest/gtest.h>

#include "floc/base/random.h"
#include "floc/neighbors/find_contacts.h"
#include "floc/packing/balance.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/packing/tile.h"
#include "support/contact_laws.h"

namespace floc {
namespace {

/// Returns a square crystal of 30 x 30 disks. Except for rounding, its net forces vanish.
Packing<2> crystal(double stiffness) {
  Packing<2> packing;
  packing.law += test::linear(stiffness);
  packing.grains = Grains<2>::with_size(1);
  packing.grains.position[0] = {0.123, 0.456};
  packing.grains.radius[0] = 0.5 * (1.0 + 1.0 / stiffness);
  packing.grains.mass[0] = 1.0;
  packing = tiled<2>(packing, {30, 30});
  find_contacts(packing);
  return packing;
}

double worst_net_force(const Packing<2>& packing) {
  double worst = 0.0;
  for (const Vec<2>& f : net_forces(packing).force) worst = std::max(worst, f.norm());
  return worst;
}

TEST(RoundingFloor, IsWhatRoundedPositionsLeaveOfABalance) {
  for (const double stiffness : {1e5, 1e9}) {
    Packing<2> packing = crystal(stiffness);
    ASSERT_EQ(packing.contacts.size(), 1800u);
    EXPECT_LT(worst_net_force(packing), 1e-14) << "in two parts";
    EXPECT_LT(rounding_floor<2>(packing, Vec<2>::Constant(1.0)).force, 1e-14);
    packing.grains.position_low.clear();
    refresh_contacts(packing);
    const double floor = rounding_floor<2>(packing, Vec<2>::Constant(1.0)).force;
    // Half a unit in the last place of 30 is 1.8e-15, and each grain has four contacts.
    EXPECT_NEAR(floor / (4.0 * 0x1p-53 * 30.0 * stiffness), 1.0, 1e-3);
    EXPECT_LT(worst_net_force(packing), 2.0 * floor);
    EXPECT_GT(worst_net_force(packing), 0.05 * floor);
  }
}

}  // namespace
}  // namespace floc
