#pragma once

#include <cstdint>
#include <vector>

#include "floc/relaxation/pair_arrays.h"
#include "floc/relaxation/sweep_plan.h"

namespace floc {

/// Returns the place of the first number of the row (force and moments) of a pair in the array of all rows, counted in
/// doubles.
/// @param row_size  number of doubles in a row
/// @throws InputError if the place does not fit the integer type of the plans, which happens with more than 537 million
/// pairs under a law with friction
int row_place(std::int64_t pair, int row_size);

/// Rows (records with the force and the moments) that the pairs of all interactions write, and plans of the rows that
/// are summed for each grain: first the rows of the pairs in which it is the first grain, then the rows of the pairs in
/// which it is the second grain, each in the order of the lists and of their pairs. The rows of pairs of grains are
/// kept until they are summed. The rows of a later group of pairs of the same thread then take their places, so that
/// few places are in use and stay in the caches.
template <int Dim>
class RowSums {
 public:
  RowSums() = default;
  // The object cannot be copied, because the plans contain pointers into the lists of rows.
  RowSums(RowSums&&) noexcept = default;
  RowSums& operator=(RowSums&&) noexcept = default;
  /// @param lists  pairs of grains, then pairs of grains with walls if there are any; the rows of pairs with walls are
  /// never overwritten
  /// @param plan  order in which the forces of pairs are computed and the forces on blocks of grains are summed
  RowSums(const std::vector<const PairArrays<Dim>*>& lists, RowKind rows, int n_grains, const SweepPlan& plan);

  /// Returns the address of the first row (force and moments) of the pairs of a group of blocks.
  double* rows_of_group(int group) { return rows_.data() + first_row_[group]; }
  double* rows_with_walls() { return rows_.data() + first_row_with_walls_; }
  const BlockSumsPlan& plan(int block) const { return plans_[block]; }

 private:
  using Lists = std::vector<const PairArrays<Dim>*>;
  /// Places of the rows of the pairs in which each grain is the first grain, or the second grain.
  struct RowsOfGrains {
    /// Index in `row` of the first entry of each grain; the last entry is the size of `row`.
    std::vector<int> first;
    std::vector<int> row;
    int count(int grain) const { return first[grain + 1] - first[grain]; }
  };

  void place_rows(const Lists& lists, const SweepPlan& plan);
  int place_of_row(const Lists& lists, const SweepPlan& plan, std::size_t list, int pair) const;
  template <class GrainOf>
  RowsOfGrains rows_of(const Lists& lists, const SweepPlan& plan, const GrainOf& grain_of) const;
  void plan_side(SideSumsPlan& plan, int begin, const RowsOfGrains& rows);
  void plan_crossings(const PairArrays<Dim>& pairs);

  int row_size_ = 0;  ///< number of doubles in the row (force and moments) of a pair
  // The following members are places in the array rows_, counted in doubles.
  int zero_row_ = 0;  ///< place of a row of zeros, which fills up sums over fewer pairs
  int first_row_with_walls_ = 0;
  /// Place of the first row (force and moments of a pair) of each group of blocks.
  std::vector<int> first_row_;
  AlignedVector<double> rows_;
  std::vector<BlockSumsPlan> plans_;
  /// Places of the rows (forces and moments) to be summed, and indices of the pairs across the periodic boundary; the
  /// plans point into these two lists.
  std::vector<int> listed_rows_, crossing_;
};

}  // namespace floc
