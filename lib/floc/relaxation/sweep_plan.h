#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "floc/relaxation/pair_arrays.h"

namespace floc {

/// Order in which threads process the blocks of grains in a time step. A pair belongs to the block of its first grain.
/// Each thread owns consecutive groups of blocks and processes one group after the other:
/// 1. It moves (drifts) those blocks that are read by the pairs of the group and have not yet moved in this step.
/// 2. It computes the forces of the pairs of the group.
/// 3. It sums the forces on the grains of the group.
///
/// In this order, the grains of a large packing are read from memory only once per step. Blocks that are also read by
/// pairs of another thread are called shared. Shared blocks drift before all other blocks, and the forces on their
/// grains are summed after the forces of all pairs have been computed. If there are many shared blocks, all blocks are
/// treated as shared.
class SweepPlan {
 public:
  SweepPlan() = default;
  /// @param blocks_of_group  number of blocks per group; has to be a multiple of the number for which `pairs` was
  /// padded
  template <int Dim>
  SweepPlan(const PairArrays<Dim>& pairs, int n_blocks, int n_threads, int blocks_of_group);

  int n_threads() const { return n_threads_; }
  int n_groups() const { return (n_blocks_ + blocks_of_group_ - 1) / blocks_of_group_; }
  int group_of(int block) const { return block / blocks_of_group_; }
  /// Returns the index of the first block of a group. If `group` equals the number of groups, returns the number of
  /// blocks.
  int first_block(int group) const { return std::min(group * blocks_of_group_, n_blocks_); }
  /// Returns the index of the first group of a thread. If `thread` equals the number of threads, returns the number of
  /// groups.
  int first_group(int thread) const { return n_groups() * thread / n_threads_; }
  bool is_shared(int block) const { return is_shared_[block]; }
  /// Returns the shared blocks that are assigned to a thread. A block is shared if several threads compute pairs with
  /// grains of the block. The assigned thread moves these grains and sums the forces on them. Every thread gets about
  /// equally many shared blocks.
  std::span<const int> shared_of(int thread) const {
    const auto first = [&](std::size_t t) { return shared_.size() * t / n_threads_; };
    return std::span(shared_).subspan(first(thread), first(thread + 1) - first(thread));
  }
  /// Returns the blocks that drift just before the forces of the pairs of this group are computed. These blocks are not
  /// shared, pairs of this group read them, and pairs of earlier groups do not.
  std::span<const int> drifting_for(int group) const {
    return std::span(drifting_).subspan(first_drifting_[group],
                                        first_drifting_[group + 1] - first_drifting_[group]);
  }

 private:
  int n_blocks_ = 0, n_threads_ = 1, blocks_of_group_ = 1;
  std::vector<bool> is_shared_;
  std::vector<int> shared_, drifting_;
  /// For each group of blocks: index of its first entry in drifting_. The last entry is the size of drifting_.
  std::vector<int> first_drifting_;
};

template <int Dim>
SweepPlan::SweepPlan(const PairArrays<Dim>& pairs, int n_blocks, int n_threads, int blocks_of_group)
    : n_blocks_(n_blocks), blocks_of_group_(blocks_of_group), is_shared_(n_blocks, false) {
  n_threads_ = std::clamp(n_threads, 1, n_groups());
  const auto for_each_second_block = [&](int group, const auto& visit) {
    for (int p = pairs.first_of_block(first_block(group)); p < pairs.first_of_block(first_block(group + 1));
         ++p)
      visit(pairs.j(p) / kGrainBlock);
  };
  for (int t = 0; t < n_threads_; ++t)
    for (int g = first_group(t); g < first_group(t + 1); ++g)
      for_each_second_block(g, [&](int b) {
        // The second grain of a pair comes after the first grain. The block of the second grain therefore belongs to
        // this thread or to a thread with a higher number.
        if (group_of(b) >= first_group(t + 1)) is_shared_[b] = true;
      });
  // A block is shared if pairs of threads with lower numbers read it. No block of the first thread is shared, so with
  // many shared blocks the first thread would have more work than the others.
  if (std::count(is_shared_.begin(), is_shared_.end(), true) > n_blocks / 8) is_shared_.assign(n_blocks, true);
  for (int b = 0; b < n_blocks; ++b)
    if (is_shared_[b]) shared_.push_back(b);
  std::vector<bool> listed = is_shared_;
  const auto list = [&](int b) {
    if (!listed[b]) drifting_.push_back(b);
    listed[b] = true;
  };
  for (int g = 0; g < n_groups(); ++g) {
    first_drifting_.push_back(static_cast<int>(drifting_.size()));
    for (int b = first_block(g); b < first_block(g + 1); ++b) list(b);
    for_each_second_block(g, list);
  }
  first_drifting_.push_back(static_cast<int>(drifting_.size()));
}

}  // namespace floc
