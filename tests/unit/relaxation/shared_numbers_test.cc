#include <gtest/gtest.h>

#include "support/listed_gas.h"

/// A parameter that is equal for all grains, or for all pairs, is stored only once. This makes steps faster.
namespace floc {
namespace {

/// The grains do not fill their last block, which is padded.
constexpr int kGrains = 3 * kGrainBlock / 2;

TEST(SharedNumbers, OfEqualGrainsAreKeptOnce) {
  test::ListedGas gas(kGrains);
  EXPECT_EQ(gas.grains.view({}, {}).own_masses, 0);
  EXPECT_EQ(gas.pair_view().own_numbers, 0);
}

TEST(SharedNumbers, OfUnequalGrainsAreTheirOwn) {
  test::ListedGas gas(kGrains, 1, test::ListedGas::Sizes::unequal);
  EXPECT_EQ(gas.grains.view({}, {}).own_masses, -1);
  EXPECT_EQ(gas.pair_view().own_numbers, -1);
}

}  // namespace
}  // namespace floc
