#pragma once

#include <algorithm>
#include <vector>

#include "floc/relaxation/pair_arrays.h"

namespace floc {

/// Order in which blocks of grains drift where each does so just before pairs read it for the first time: those of a
/// large packing are in the caches then, which they would leave in a drift of all grains.
struct DriftOrder {
  std::vector<int> block;
  std::vector<int> end;  ///< in `block`, of those that the pairs of each group of blocks need

  DriftOrder() = default;
  /// @param blocks_of_group  blocks whose pairs are computed in one pass
  template <int Dim>
  DriftOrder(const PairArrays<Dim>& pairs, int n_blocks, int blocks_of_group);
};

template <int Dim>
DriftOrder::DriftOrder(const PairArrays<Dim>& pairs, int n_blocks, int blocks_of_group) {
  std::vector<bool> listed(n_blocks, false);
  const auto list = [&](int b) {
    if (!listed[b]) block.push_back(b);
    listed[b] = true;
  };
  for (int first = 0; first < n_blocks; first += blocks_of_group) {
    const int last = std::min(first + blocks_of_group, n_blocks);
    for (int b = first; b < last; ++b) list(b);
    for (int p = pairs.first_of_block(first); p < pairs.first_of_block(last); ++p)
      list(pairs.j(p) / kGrainBlock);
    end.push_back(static_cast<int>(block.size()));
  }
}

}  // namespace floc
