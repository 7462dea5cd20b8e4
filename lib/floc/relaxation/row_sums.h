#pragma once

#include <cstdint>
#include <vector>

#include "floc/relaxation/pair_arrays.h"

namespace floc {

/// Where the row of a pair begins among all rows (in doubles).
/// @param row_size  doubles of a row
/// @throws InputError if it is beyond what the sums' plans can address, at 537 million pairs with friction
int row_place(std::int64_t pair, int row_size);

/// Rows of pairs of grains that are kept at a time.
enum class RowsKept {
  all,        ///< for threads that share the blocks
  one_block,  ///< which take a small part of the memory, and stay in the cache
};

/// The rows that the pairs of all interactions write (PairView::row), list after list, and the rows that each
/// grain sums: those of pairs in which it is the first grain, then the second, either in the order of the lists
/// and of their pairs. Where the rows of one block alone are kept, blocks come in order, and what a block adds to
/// second grains is added to sums of theirs (sums_as_j()) before the next writes its rows: the same additions.
template <int Dim>
class RowSums {
 public:
  RowSums() = default;
  RowSums(RowSums&&) noexcept = default;  // no copies: the plans point into the lists of rows
  RowSums& operator=(RowSums&&) noexcept = default;
  /// @param lists    first of pairs of grains, then perhaps of grains with walls
  RowSums(const std::vector<const PairArrays<Dim>*>& lists, RowKind rows, int n_grains,
          RowsKept kept = RowsKept::all);

  /// Where the rows of a list begin, of pairs of grains perhaps those of one block.
  double* rows(std::size_t list) { return rows_.data() + first_row_[list]; }
  /// Sums of each grain's rows as the second of a pair, where the rows of one block are kept.
  double* sums_as_j() { return sums_as_j_.data(); }
  const BlockSumsPlan& plan(int block) const { return plans_[block]; }

 private:
  /// For each grain, where the rows begin of the pairs in which it is the first, or the second, grain.
  struct RowsOfGrains {
    std::vector<int> first;  ///< of each grain in `row`, and the end
    std::vector<int> row;
    int count(int grain) const { return first[grain + 1] - first[grain]; }
  };

  template <class GrainOf>
  RowsOfGrains rows_of(const std::vector<const PairArrays<Dim>*>& lists, const GrainOf& grain_of) const;
  void place_rows(const std::vector<const PairArrays<Dim>*>& lists);
  int place_of_row(const std::vector<const PairArrays<Dim>*>& lists, std::size_t list, int pair) const;
  void plan_side(SideSumsPlan& plan, int begin, const RowsOfGrains& rows);
  void plan_crossings(const PairArrays<Dim>& pairs);

  RowsKept kept_ = RowsKept::all;
  int row_size_ = 0;            ///< doubles
  int zero_row_ = 0;            ///< place of the row that stays zero
  std::vector<int> first_row_;  ///< place of the first row of each list
  AlignedVector<double> rows_, sums_as_j_;
  std::vector<BlockSumsPlan> plans_;
  std::vector<int> listed_rows_, crossing_;  ///< what the plans point into
};

}  // namespace floc
