#include "floc/relaxation/neighbor_lists.h"

#include <gtest/gtest.h>

#include "support/contact_laws.h"
#include "support/few_grains.h"

namespace floc {
namespace {

/// Fixture: two disks of unit diameter at rest, with a gap of 0.05, under a law that acts only in contact.
class NeighborListsOfTwoDisks : public testing::Test {
 protected:
  NeighborLists<2> lists_with_skin(double skin) const {
    return {grains_, cell_, skin, SkinRule::balances_costs};
  }
  std::size_t pairs_within(double skin) const {
    return lists_with_skin(skin).find(grains_, cell_, interactions_)[0].size();
  }
  /// Moves the second disk. The lists then measure its displacement.
  void move(double distance, NeighborLists<2>& lists) {
    grains_.x[1][1] += distance;
    lists.motion().measure(0, interactions_.between_grains().kernels(), lists.motion().view_of(grains_));
    lists.motion().take_measured();
  }

  Packing<2> packing_ =
      test::unit_grains<2>({{4.0, 5.0}, {5.05, 5.0}}, 10.0, test::law_of({test::linear(1.0)}));
  GrainArrays<2> grains_{packing_.grains, {0, 1}};
  CellMotion<2> cell_{packing_.cell, {}, BoundaryControl<2>::fixed()};
  Interactions<2> interactions_{packing_, widest_instruction_set(), LatticeShape::rectangular};
};

TEST_F(NeighborListsOfTwoDisks, HoldPairsCloserThanTheSkin) {
  EXPECT_EQ(pairs_within(0.04), 0u);
  EXPECT_EQ(pairs_within(0.06), 1u);
}

TEST_F(NeighborListsOfTwoDisks, AreStaleOnceAGrainHasMovedByHalfTheSkin) {
  NeighborLists<2> lists = lists_with_skin(0.1);
  lists.find(grains_, cell_, interactions_);
  EXPECT_FALSE(lists.stale(cell_, 0.0));
  move(0.045, lists);
  EXPECT_NEAR(lists.motion().of_grains(), 0.9, 1e-12);
  EXPECT_FALSE(lists.stale(cell_, 0.0));
  move(0.01, lists);
  EXPECT_TRUE(lists.stale(cell_, 0.0));
}

TEST_F(NeighborListsOfTwoDisks, AreStaleWhereTheBoundOfTheMotionHasBeenGivenUp) {
  NeighborLists<2> lists = lists_with_skin(0.1);
  lists.find(grains_, cell_, interactions_);
  lists.motion().forget();
  EXPECT_TRUE(lists.stale(cell_, 0.0));
}

TEST_F(NeighborListsOfTwoDisks, GiveFasterGrainsMoreOfTheSkin) {
  grains_.v[0][0] = 1.0;
  grains_.v[0][1] = 0.5;
  NeighborLists<2> lists = lists_with_skin(0.1);
  lists.find(grains_, cell_, interactions_);
  const double* const inverse = lists.motion().view_of(grains_).inverse_skin_squared;
  EXPECT_DOUBLE_EQ(inverse[1], 4.0 * inverse[0]);
}

TEST_F(NeighborListsOfTwoDisks, HaveASkinThatFollowsTheReachUnderThatRule) {
  interactions_.between_grains().set_range(0.4);
  NeighborLists<2> lists(grains_, cell_, 1e-3, SkinRule::follows_reach);
  lists.find(grains_, cell_, interactions_);
  EXPECT_DOUBLE_EQ(lists.skin_to_continue_with(cell_, 0.4), 0.1);  // a quarter of the reach
}

}  // namespace
}  // namespace floc
