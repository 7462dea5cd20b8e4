#include "floc/relaxation/row_sums.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "floc/base/error.h"
#include "floc/relaxation/drift_order.h"
#include "support/listed_gas.h"

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

/// Calls visit(grain of the block, row) for each place that a side of a block's sums reads.
template <class Visit>
void for_each_row(const SideSumsPlan& side, const double* rows, const Visit& visit) {
  const int* place = side.row;
  for (int g = 0; g < SideSumsPlan::kGroups; ++g)
    for (int d = 0; d < side.depth[g]; ++d)
      for (int l = 0; l < kSumGroup; ++l) visit(side.grain[g * kSumGroup + l], rows + *place++);
  for (int k = 0; k < side.n_deep; ++k)
    for (int d = 0; d < side.n_beyond[k]; ++d) visit(side.grain[k], rows + *place++);
}

TEST(RowSums, ReadEveryRowOnceForEitherGrainBeforeAnotherTakesItsPlace) {
  constexpr int kBlocksOfGroup = 2;
  test::ListedGas gas(3000, kBlocksOfGroup);
  const PairArrays<3>& pairs = gas.pairs();
  const RowKind kind = RowKind::levers;
  RowSums<3> sums({&pairs}, kind, gas.grains.size(), RowsKept::until_summed, kBlocksOfGroup);
  std::multiset<int> as_i, as_j;
  std::set<const double*> places;
  for (int group = 0, first = 0; first < gas.n_blocks(); first += kBlocksOfGroup, ++group) {
    const int last = std::min(first + kBlocksOfGroup, gas.n_blocks());
    double* row = sums.rows_of_group(group);
    places.insert(row);
    for (int p = pairs.first_of_block(first); p < pairs.first_of_block(last); ++p, row += row_size<3>(kind))
      *row = pairs.padding(p) ? 0.0 : 1.0 + p;  // where a force would stand, which pair it is
    for (int b = first; b < last; ++b) {
      const BlockSumsPlan& plan = sums.plan(b);
      const auto read = [&](std::multiset<int>& side, int grain_of_pair, int k, int p) {
        EXPECT_EQ(grain_of_pair, b * kGrainBlock + k);
        side.insert(p);
      };
      for_each_row(plan.as_i, plan.rows, [&](int k, const double* number) {
        if (const int p = static_cast<int>(*number) - 1; p >= 0) read(as_i, pairs.i(p), k, p);
      });
      for_each_row(plan.as_j, plan.rows, [&](int k, const double* number) {
        if (const int p = static_cast<int>(*number) - 1; p >= 0) read(as_j, pairs.j(p), k, p);
      });
    }
  }
  std::multiset<int> all;
  for (int p = 0; p < pairs.size(); ++p)
    if (!pairs.padding(p)) all.insert(p);
  EXPECT_GT(all.size(), 3000u);
  EXPECT_EQ(as_i, all);
  EXPECT_EQ(as_j, all);
  EXPECT_LT(places.size(), gas.n_blocks() / kBlocksOfGroup);
}

TEST(DriftOrder, HasEveryBlockOnceAndNoLaterThanPairsReadIt) {
  constexpr int kBlocksOfGroup = 2;
  test::ListedGas gas(3000, kBlocksOfGroup);
  const PairArrays<3>& pairs = gas.pairs();
  const DriftOrder order(pairs, gas.n_blocks(), kBlocksOfGroup);
  std::set<int> drifted;
  for (int group = 0, first = 0; first < gas.n_blocks(); first += kBlocksOfGroup, ++group) {
    for (int k = group == 0 ? 0 : order.end[group - 1]; k < order.end[group]; ++k)
      EXPECT_TRUE(drifted.insert(order.block[k]).second);
    const int last = std::min(first + kBlocksOfGroup, gas.n_blocks());
    for (int b = first; b < last; ++b) EXPECT_TRUE(drifted.contains(b));
    for (int p = pairs.first_of_block(first); p < pairs.first_of_block(last); ++p)
      EXPECT_TRUE(drifted.contains(pairs.j(p) / kGrainBlock));
  }
  EXPECT_EQ(drifted.size(), gas.n_blocks());
}

}  // namespace
}  // namespace floc
