#include "floc/base/disjoint_sets.h"

#include <gtest/gtest.h>

namespace floc {
namespace {

TEST(DisjointSets, AreNamedByTheirSmallestMemberWhateverTheOrderOfJoins) {
  DisjointSets up(6), down(6);
  EXPECT_EQ(up.n_sets(), 6);
  EXPECT_TRUE(up.join(1, 3));
  EXPECT_TRUE(up.join(3, 5));
  EXPECT_FALSE(up.join(5, 1));
  EXPECT_TRUE(down.join(5, 3));
  EXPECT_TRUE(down.join(5, 1));
  for (const int i : {1, 3, 5}) {
    EXPECT_EQ(up.root(i), 1);
    EXPECT_EQ(down.root(i), 1);
  }
  EXPECT_EQ(up.root(2), 2);
  EXPECT_EQ(up.n_sets(), 4);
}

}  // namespace
}  // namespace floc
