#include "floc/relaxation/useful_threads.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace floc {
namespace {

using ::testing::StartsWith;

TEST(UsefulThreads, AreOneForEach1400DisksOr500Spheres) {
  EXPECT_EQ(useful_threads(1400, 2, 2), 1);
  EXPECT_EQ(useful_threads(2799, 2, 2), 1);
  EXPECT_EQ(useful_threads(2800, 2, 2), 2);
  EXPECT_EQ(useful_threads(999, 3, 2), 1);
  EXPECT_EQ(useful_threads(1000, 3, 2), 2);
  EXPECT_EQ(useful_threads(5600, 2, 16), 4);
}

TEST(UsefulThreads, AreNeverLessThanOneNorMoreThanAskedFor) {
  for (const int dimension : {2, 3})
    for (const int n_grains : {0, 2, 499, 1400, 100'000'000})
      for (const int asked : {1, 2, 1024}) {
        const int used = useful_threads(n_grains, dimension, asked);
        EXPECT_GE(used, 1);
        EXPECT_LE(used, asked);
        EXPECT_EQ(unused_threads(n_grains, dimension, asked).empty(), used == asked);
      }
}

TEST(UsefulThreads, AreToldInWordsWhereOthersStayUnused) {
  EXPECT_THAT(unused_threads(1400, 2, 2), StartsWith("1400 disks: 1 of 2 threads is used, since"));
  EXPECT_THAT(unused_threads(1400, 3, 4), StartsWith("1400 spheres: 2 of 4 threads are used, since"));
  EXPECT_EQ(unused_threads(2800, 2, 2), "");
}

}  // namespace
}  // namespace floc
