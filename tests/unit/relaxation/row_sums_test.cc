#include "floc/relaxation/row_sums.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "floc/base/error.h"
#include "floc/relaxation/sweep_plan.h"
#include "support/listed_gas.h"

namespace floc {
namespace {

TEST(RowPlace, HoldsBeyondTheRowsThatTwoGigabytesHold) {
  // Number of pairs for which the byte offsets of rows of 32 bytes do not fit into an int.
  constexpr int kPairs = 1 << 26;
  EXPECT_EQ(row_place(kPairs, row_size<2>(RowKind::moments)), 4LL * kPairs);
  EXPECT_EQ(row_place(2 * kPairs, row_size<2>(RowKind::forces)), 4LL * kPairs);
}

TEST(RowPlace, RefusesMorePairsThanItCanName) {
  EXPECT_EQ(row_place(536'870'911, row_size<2>(RowKind::moments)), 2'147'483'644);
  EXPECT_THAT([] { (void)row_place(536'870'912, row_size<2>(RowKind::moments)); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr("536870911 pairs of neighbouring grains")));
}

/// Calls visit(grain, row) for each row of forces that contributes to one side of the sums of a block. `grain` is the
/// number of the grain within the block.
template <class Visit>
void for_each_row(const SideSumsPlan& side, const double* rows, const Visit& visit) {
  const int* place = side.row;
  for (int g = 0; g < SideSumsPlan::kGroups; ++g)
    for (int d = 0; d < side.depth[g]; ++d)
      for (int l = 0; l < kSumGroup; ++l) visit(side.grain[g * kSumGroup + l], rows + *place++);
  for (int k = 0; k < side.n_deep; ++k)
    for (int d = 0; d < side.n_beyond[k]; ++d) visit(side.grain[k], rows + *place++);
}

constexpr int kBlocksOfGroup = 2;

class Sweeps : public testing::TestWithParam<int> {
 protected:
  /// Visits the groups of blocks of all threads, alternating between threads.
  template <class Visit>
  void for_each_group(const Visit& visit) const {
    for (int k = 0; k < plan_.n_groups(); ++k)
      for (int t = 0; t < plan_.n_threads(); ++t)
        if (const int g = plan_.first_group(t) + k; g < plan_.first_group(t + 1)) visit(g);
  }

  test::ListedGas gas_{12'000, kBlocksOfGroup};
  const PairArrays<3>& pairs_ = gas_.pairs();
  SweepPlan plan_{pairs_, gas_.n_blocks(), GetParam(), kBlocksOfGroup};
};

TEST_P(Sweeps, ReadEveryRowOnceForEitherGrainBeforeAnotherTakesItsPlace) {
  const RowKind kind = RowKind::levers;
  RowSums<3> sums({&pairs_}, kind, gas_.grains.size(), plan_);
  std::multiset<int> as_i, as_j;
  std::set<const double*> places;
  const auto sum = [&](int b) {
    const BlockSumsPlan& plan = sums.plan(b);
    const auto read = [&](std::multiset<int>& side, int grain_of_pair, int k, int p) {
      EXPECT_EQ(grain_of_pair, b * kGrainBlock + k);
      side.insert(p);
    };
    for_each_row(plan.as_i, plan.rows, [&](int k, const double* number) {
      if (const int p = static_cast<int>(*number) - 1; p >= 0) read(as_i, pairs_.i(p), k, p);
    });
    for_each_row(plan.as_j, plan.rows, [&](int k, const double* number) {
      if (const int p = static_cast<int>(*number) - 1; p >= 0) read(as_j, pairs_.j(p), k, p);
    });
  };
  for_each_group([&](int group) {
    const int first = plan_.first_block(group), last = plan_.first_block(group + 1);
    double* row = sums.rows_of_group(group);
    places.insert(row);
    for (int p = pairs_.first_of_block(first); p < pairs_.first_of_block(last); ++p, row += row_size<3>(kind))
      *row = pairs_.padding(p) ? 0.0 : 1.0 + p;  // stores the number of the pair in place of its force
    for (int b = first; b < last; ++b)
      if (!plan_.is_shared(b)) sum(b);
  });
  for (int t = 0; t < plan_.n_threads(); ++t)
    for (const int b : plan_.shared_of(t)) sum(b);
  std::multiset<int> all;
  for (int p = 0; p < pairs_.size(); ++p)
    if (!pairs_.padding(p)) all.insert(p);
  EXPECT_GT(all.size(), 12'000u);
  EXPECT_EQ(as_i, all);
  EXPECT_EQ(as_j, all);
  EXPECT_LT(places.size(), static_cast<std::size_t>(plan_.n_groups() / 2));
}

TEST_P(Sweeps, DriftEveryBlockOnceAndNoLaterThanPairsReadIt) {
  std::set<int> drifted;
  for (int t = 0; t < plan_.n_threads(); ++t)
    for (const int b : plan_.shared_of(t)) EXPECT_TRUE(drifted.insert(b).second);
  for_each_group([&](int group) {
    for (const int b : plan_.drifting_for(group)) EXPECT_TRUE(drifted.insert(b).second);
    const int first = plan_.first_block(group), last = plan_.first_block(group + 1);
    for (int b = first; b < last; ++b) EXPECT_TRUE(drifted.contains(b));
    for (int p = pairs_.first_of_block(first); p < pairs_.first_of_block(last); ++p)
      EXPECT_TRUE(drifted.contains(pairs_.j(p) / kGrainBlock));
  });
  EXPECT_EQ(drifted.size(), static_cast<std::size_t>(gas_.n_blocks()));
}

/// A block of grains that pairs of several threads read is shared. Each other block is read by the pairs of one thread
/// only, which updates its positions and sums.
TEST_P(Sweeps, ShareWhatSeveralThreadsRead) {
  EXPECT_EQ(plan_.shared_of(0).empty(), plan_.n_threads() == 1);
  EXPECT_FALSE(plan_.drifting_for(0).empty());
  const auto thread_of = [&](int block) {
    int t = 0;
    while (plan_.group_of(block) >= plan_.first_group(t + 1)) ++t;
    return t;
  };
  for (int p = 0; p < pairs_.size(); ++p) {
    const int i = pairs_.i(p) / kGrainBlock, j = pairs_.j(p) / kGrainBlock;
    EXPECT_TRUE(plan_.is_shared(j) || thread_of(i) == thread_of(j));
  }
  for (int g = 0; g < plan_.n_groups(); ++g)
    for (const int b : plan_.drifting_for(g)) EXPECT_EQ(thread_of(b), thread_of(plan_.first_block(g)));
}

INSTANTIATE_TEST_SUITE_P(Threads, Sweeps, testing::Values(1, 2, 3));

}  // namespace
}  // namespace floc
