#include <gtest/gtest.h>

#include "floc/elasticity/indeterminacy.h"
#include "support/force_components.h"
#include "support/rigid_states.h"

namespace floc::test {
namespace {

TEST(RigidIndeterminacy, IsTheNumberOfComponentsMinusTheRankOfTheBalance) {
  for (const double friction : {0.0, 0.3}) {
    const State<2> disks = triangular_crystal(0.7, friction), bricks = brick_bond(0.7, friction);
    const State<3> spheres = cubic_crystal(0.7, friction);
    EXPECT_EQ(rigid_indeterminacy(disks.packing, 0.0).degree,
              counted_indeterminacy(disks.packing, friction > 0.0));
    EXPECT_EQ(rigid_indeterminacy(bricks.packing, 0.0).degree,
              counted_indeterminacy(bricks.packing, friction > 0.0));
    EXPECT_EQ(rigid_indeterminacy(spheres.packing, 0.0).degree,
              counted_indeterminacy(spheres.packing, friction > 0.0));
  }
}

/// The crystal has 27 lines of three spheres. The forces of a line are equal, so there are 27 independent forces. The
/// three given stresses along the axes are three equations for these forces.
TEST(RigidIndeterminacy, OfACubicCrystalWithoutFrictionIsThatOfItsLines) {
  EXPECT_EQ(rigid_indeterminacy(cubic_crystal(0.7, 0.0).packing, 0.0).degree, 27 - 3);
}

TEST(RigidIndeterminacy, CountsOneComponentOfAContactThatSlides) {
  State<2> state = triangular_crystal(0.7, 0.3);
  for (Contact<2>& c : state.packing.contacts) c.sliding = true;
  EXPECT_EQ(rigid_indeterminacy(state.packing, 0.0).degree, counted_indeterminacy(state.packing, false));
}

TEST(RigidIndeterminacy, LeavesOutContactsThatCarryNothing) {
  State<2> state = brick_bond(0.7, 0.3), fewer = state;
  const Contact<2> idle = state.packing.contacts.front();
  state.packing.contacts.front().normal_force = state.packing.contacts.front().elastic_force = 0.0;
  std::erase_if(fewer.packing.contacts, [&](const Contact<2>& c) {
    return c.i == idle.i && c.j == idle.j && c.key == idle.key && c.image == idle.image;
  });
  EXPECT_EQ(rigid_indeterminacy(state.packing, 0.0).degree, counted_indeterminacy(fewer.packing, true));
}

}  // namespace
}  // namespace floc::test
