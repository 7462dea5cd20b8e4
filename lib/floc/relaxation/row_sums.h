#pragma once

#include <cstdint>
#include <vector>

#include "floc/relaxation/pair_arrays.h"
#include "floc/relaxation/sweep_plan.h"

namespace floc {

/// Returns the place of the row (force and moments) of a pair in the array of all rows: the number of doubles from the
/// beginning of that array.
/// @param pair  number of rows before this row
/// @param row_size  number of doubles in a row
/// @throws InputError if the place exceeds the largest int; with friction, this happens with more than 537 million
/// pairs
int row_place(std::int64_t pair, int row_size);

/// Memory for the rows (force and moments of each pair) that force kernels write, and plans by which the rows are
/// summed for each grain. For each grain, the rows of the pairs in which it is the first grain are summed first, then
/// the rows of the pairs in which it is the second grain. Within each of the two sums, the rows are in the order of the
/// lists, and within a list in the order of the pairs. After the rows of a group of pairs of grains have been summed,
/// their memory is reused for a later group of the same thread. The memory thus stays small enough for the caches.
template <int Dim>
class RowSums {
 public:
  RowSums() = default;
  // The object cannot be copied, because the plans contain pointers to its arrays.
  RowSums(RowSums&&) noexcept = default;
  RowSums& operator=(RowSums&&) noexcept = default;
  /// @param lists  lists of pairs: first the pairs of grains, then the pairs of grains with walls if there are walls.
  /// Memory is not reused for the rows of pairs with walls
  /// @param plan  order in which the forces of pairs are computed and the forces on blocks of grains are summed
  RowSums(const std::vector<const PairArrays<Dim>*>& lists, RowKind rows, int n_grains, const SweepPlan& plan);

  /// Returns the address of the first row (force and moments of a pair) of a group of blocks of grains.
  double* rows_of_group(int group) { return rows_.data() + first_row_[group]; }
  double* rows_with_walls() { return rows_.data() + first_row_with_walls_; }
  const BlockSumsPlan& plan(int block) const { return plans_[block]; }

 private:
  using Lists = std::vector<const PairArrays<Dim>*>;
  /// Places of the rows (forces and moments) of each grain, either for the pairs in which the grain is the first grain,
  /// or for the pairs in which it is the second grain.
  struct RowsOfGrains {
    /// Index in `row` of the first entry of each grain; the last entry of `first` is the size of `row`.
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
  /// Index in rows_ of the first number of a row of zeros, which replaces the missing rows of grains with few pairs.
  int zero_row_ = 0;
  int first_row_with_walls_ = 0;
  /// For each group of blocks of grains: index in rows_ of its first row (force and moments of a pair).
  std::vector<int> first_row_;
  AlignedVector<double> rows_;
  std::vector<BlockSumsPlan> plans_;
  /// Lists to which the pointers in the plans refer: places of the rows (force and moments of a pair) to be summed, and
  /// indices of the pairs that interact across the periodic boundary.
  std::vector<int> listed_rows_, crossing_;
};

}  // namespace floc
