#pragma once

#include <cstdint>
#include <vector>

#include "floc/relaxation/pair_arrays.h"
#include "floc/relaxation/sweep_plan.h"

namespace floc {

/// Place of the first number of a pair's row among all rows (in doubles).
/// @param row_size  doubles of a row
/// @throws InputError if the place does not fit the integers of the plans, from 537 million pairs with friction
/// on
int row_place(std::int64_t pair, int row_size);

/// Rows that the pairs of all interactions write, and the rows that each grain sums: first those of pairs in
/// which it is the first grain, then those in which it is the second, each in the order of the lists and of
/// their pairs. Rows of pairs of grains are kept until they are summed. Rows of a later group of the same
/// thread then take their places, so that few places are in use and stay in the caches.
template <int Dim>
class RowSums {
 public:
  RowSums() = default;
  RowSums(RowSums&&) noexcept = default;  // no copies: the plans point into the lists of rows
  RowSums& operator=(RowSums&&) noexcept = default;
  /// @param lists  pairs of grains, then pairs of grains with walls if there are any, whose rows are never
  /// overwritten
  /// @param plan  order in which pairs are computed and blocks are summed
  RowSums(const std::vector<const PairArrays<Dim>*>& lists, RowKind rows, int n_grains, const SweepPlan& plan);

  /// First row of the pairs of a group.
  double* rows_of_group(int group) { return rows_.data() + first_row_[group]; }
  double* rows_with_walls() { return rows_.data() + first_row_with_walls_; }
  const BlockSumsPlan& plan(int block) const { return plans_[block]; }

 private:
  using Lists = std::vector<const PairArrays<Dim>*>;
  /// Places of the rows that each grain sums as the first, or as the second, grain of a pair.
  struct RowsOfGrains {
    std::vector<int> first;  ///< index in `row` of the first entry of each grain, and the end
    std::vector<int> row;
    int count(int grain) const { return first[grain + 1] - first[grain]; }
  };

  void place_rows(const Lists& lists, const SweepPlan& plan);
  int place_of_row(const Lists& lists, const SweepPlan& plan, std::size_t list, int pair) const;
  template <class GrainOf>
  RowsOfGrains rows_of(const Lists& lists, const SweepPlan& plan, const GrainOf& grain_of) const;
  void plan_side(SideSumsPlan& plan, int begin, const RowsOfGrains& rows);
  void plan_crossings(const PairArrays<Dim>& pairs);

  int row_size_ = 0;  ///< doubles
  // Places in rows_:
  int zero_row_ = 0;  ///< place of the row that stays zero
  int first_row_with_walls_ = 0;
  std::vector<int> first_row_;  ///< place of the first row of each group
  AlignedVector<double> rows_;
  std::vector<BlockSumsPlan> plans_;
  std::vector<int> listed_rows_, crossing_;  ///< lists that the plans point into
};

}  // namespace floc
