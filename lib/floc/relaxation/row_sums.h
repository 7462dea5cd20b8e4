#pragma once

#include <cstdint>
#include <vector>

#include "floc/relaxation/pair_arrays.h"
#include "floc/relaxation/sweep_plan.h"

namespace floc {

/// Where the row of a pair begins among all rows (in doubles).
/// @param row_size  doubles of a row
/// @throws InputError if it is beyond what the sums' plans can address, at 537 million pairs with friction
int row_place(std::int64_t pair, int row_size);

/// The rows that the pairs of all interactions write, and the rows that each grain sums: those of pairs in which it
/// is the first grain, then the second, either in the order of the lists and of their pairs. Rows of pairs of grains
/// are kept until they are summed, when those of a later group of the same thread take over their places, few of
/// which stay in the caches.
template <int Dim>
class RowSums {
 public:
  RowSums() = default;
  RowSums(RowSums&&) noexcept = default;  // no copies: the plans point into the lists of rows
  RowSums& operator=(RowSums&&) noexcept = default;
  /// @param lists  first of pairs of grains, then perhaps of grains with walls, whose rows are kept for good
  /// @param plan   in whose order pairs are computed and blocks are summed
  RowSums(const std::vector<const PairArrays<Dim>*>& lists, RowKind rows, int n_grains, const SweepPlan& plan);

  /// Where the rows of a group's pairs begin.
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

  void place_rows(const Lists& lists, const SweepPlan& plan);
  int place_of_row(const Lists& lists, const SweepPlan& plan, std::size_t list, int pair) const;
  template <class GrainOf>
  RowsOfGrains rows_of(const Lists& lists, const SweepPlan& plan, const GrainOf& grain_of) const;
  void plan_side(SideSumsPlan& plan, int begin, const RowsOfGrains& rows);
  void plan_crossings(const PairArrays<Dim>& pairs);

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
