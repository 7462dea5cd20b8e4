#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "floc/relaxation/pair_arrays.h"

namespace floc {

/// Order in which threads go through the blocks of grains in a time step. Each thread owns consecutive groups
/// of blocks. It computes the pairs of one group after the other and sums the blocks of each group at once; a
/// block drifts just before the first pairs read it. The grains of a large packing are thus read from memory
/// once per step. Blocks that pairs of another thread's blocks read are shared: they drift before all others
/// and are summed after all pairs. If there are many such blocks, all blocks are shared.
class SweepPlan {
 public:
  SweepPlan() = default;
  /// @param blocks_of_group  blocks per group, as in `pairs` or a multiple of it
  template <int Dim>
  SweepPlan(const PairArrays<Dim>& pairs, int n_blocks, int n_threads, int blocks_of_group);

  int n_threads() const { return n_threads_; }
  int n_groups() const { return (n_blocks_ + blocks_of_group_ - 1) / blocks_of_group_; }
  int group_of(int block) const { return block / blocks_of_group_; }
  /// First block of a group, and first group of a thread; one past the last gives the end.
  int first_block(int group) const { return std::min(group * blocks_of_group_, n_blocks_); }
  int first_group(int thread) const { return n_groups() * thread / n_threads_; }
  bool is_shared(int block) const { return is_shared_[block]; }
  /// Shared blocks that a thread drifts and sums. Every thread gets an equal part of them.
  std::span<const int> shared_of(int thread) const {
    const auto first = [&](std::size_t t) { return shared_.size() * t / n_threads_; };
    return std::span(shared_).subspan(first(thread), first(thread + 1) - first(thread));
  }
  /// Blocks, not shared, that the pairs of a group are the first to read.
  std::span<const int> drifting_for(int group) const {
    return std::span(drifting_).subspan(first_drifting_[group],
                                        first_drifting_[group + 1] - first_drifting_[group]);
  }

 private:
  int n_blocks_ = 0, n_threads_ = 1, blocks_of_group_ = 1;
  std::vector<bool> is_shared_;
  std::vector<int> shared_, drifting_;
  std::vector<int> first_drifting_;  ///< first entry of each group in drifting_, and the end
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
        if (group_of(b) >= first_group(t + 1)) is_shared_[b] = true;  // second grains are later ones
      });
  // Shared blocks are those of later threads: with many of them the first thread would have more to do than the others.
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
