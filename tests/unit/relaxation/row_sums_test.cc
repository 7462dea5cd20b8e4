#include "floc/relaxation/row_sums.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "floc/base/error.h"

namespace floc {
namespace {

TEST(RowPlace, HoldsBeyondTheRowsThatTwoGigabytesHold) {
  constexpr int kPairs = 1 << 26;  // rows of 32 bytes: their bytes no longer fit an int
  EXPECT_EQ(row_place(kPairs, row_size<2>(RowKind::moments)), 4LL * kPairs);
  EXPECT_EQ(row_place(2 * kPairs, row_size<2>(RowKind::forces)), 4LL * kPairs);
}

TEST(RowPlace, RefusesMorePairsThanItCanName) {
  EXPECT_EQ(row_place(536'870'911, row_size<2>(RowKind::moments)), 2'147'483'644);
  EXPECT_THAT([] { (void)row_place(536'870'912, row_size<2>(RowKind::moments)); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr("536870911 pairs of neighbours")));
}

}  // namespace
}  // namespace floc
