#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "floc/relaxation/pair_arrays.h"

namespace floc {

/// Where the row of a pair begins among all rows (in doubles).
/// @param row_size  doubles of a row
/// @throws InputError if it is beyond what the sums' plans can address, at 537 million pairs with friction
int row_place(std::int64_t pair, int row_size);

/// How long the rows of pairs of grains keep their places.
enum class RowsKept {
  for_good,      ///< for threads that share the blocks
  until_summed,  ///< and others take over the places, few of which stay in the caches
};

/// The rows that the pairs of all interactions write, and the rows that each grain sums: those of pairs in which it
/// is the first grain, then the second, either in the order of the lists and of their pairs. Pairs of grains write
/// group by group of blocks; where rows are kept until they are summed, a group has to be summed before the next is
/// computed.
template <int Dim>
class RowSums {
 public:
  RowSums() = default;
  RowSums(RowSums&&) noexcept = default;  // no copies: the plans point into the lists of rows
  RowSums& operator=(RowSums&&) noexcept = default;
  /// @param lists            first of pairs of grains, then perhaps of grains with walls, whose rows are kept for good
  /// @param blocks_of_group  which are computed in one pass
  RowSums(const std::vector<const PairArrays<Dim>*>& lists, RowKind rows, int n_grains,
          RowsKept kept = RowsKept::for_good, int blocks_of_group = 1);

  /// Where the rows of a group's pairs begin; of rows kept for good, groups follow each other.
  double* rows_of_group(int group) { return rows_.data() + first_row_[group]; }
  double* rows_with_walls() { return rows_.data() + first_row_with_walls_; }
  const BlockSumsPlan& plan(int block) const { return plans_[block]; }

 private:
  using Lists = std::vector<const PairArrays<Dim>*>;
  /// For each grain, where the rows begin of the pairs in which it is the first, or the second, grain.
  struct RowsOfGrains {
    std::vector<int> first;  ///< of each grain in `row`, and the end
    std::vector<int> row;
    int count(int grain) const { return first[grain + 1] - first[grain]; }
  };

  int n_groups() const { return (static_cast<int>(plans_.size()) + blocks_of_group_ - 1) / blocks_of_group_; }
  int group_of(int grain) const { return grain / kGrainBlock / blocks_of_group_; }
  int first_pair(const PairArrays<Dim>& pairs, int group) const {
    return pairs.first_of_block(std::min(group * blocks_of_group_, static_cast<int>(plans_.size())));
  }
  void place_rows(const Lists& lists, RowsKept kept);
  std::vector<int> slots_of_groups(const PairArrays<Dim>& pairs) const;
  int place_of_row(const Lists& lists, std::size_t list, int pair) const;
  template <class GrainOf>
  RowsOfGrains rows_of(const Lists& lists, const GrainOf& grain_of) const;
  void plan_side(SideSumsPlan& plan, int begin, const RowsOfGrains& rows);
  void plan_crossings(const PairArrays<Dim>& pairs);

  int blocks_of_group_ = 1;
  int row_size_ = 0;  ///< doubles
  // Places in rows_:
  int zero_row_ = 0;  ///< of the row that stays zero
  int first_row_with_walls_ = 0;
  std::vector<int> first_row_;  ///< of each group
  AlignedVector<double> rows_;
  std::vector<BlockSumsPlan> plans_;
  std::vector<int> listed_rows_, crossing_;  ///< what the plans point into
};

}  // namespace floc
