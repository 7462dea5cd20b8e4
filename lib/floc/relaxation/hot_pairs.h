#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "floc/contact/law_table.h"
#include "floc/contact/memory_layout.h"
#include "floc/neighbors/pairs.h"
#include "floc/relaxation/kernels/step_kernels.h"

namespace floc {

/// Dashpot coefficient to use where the force is late by kDashpotLag steps. The lag lets a dashpot damp more than its
/// coefficient says, by the factor exp(lag c dt/(2 m_eff)) to second order in the step; without this correction a
/// restitution of 0.015 comes out as 0.006 at a tenth of sqrt(m/K_N) and half a step of lag.
inline double lagging_damping(double coefficient, double mass_i, double mass_j, double time_step) {
  const double effective_mass = reduced(mass_i, mass_j);
  return coefficient * std::exp(-0.5 * kDashpotLag * coefficient * time_step / effective_mass);
}

/// Where the row of a pair begins among the rows of all (in doubles).
/// @param row_size  doubles of a row
/// @throws InputError if it is beyond what the plans of the sums can name, at 537 million pairs with friction
int row_place(std::int64_t pair, int row_size);

/// The neighbour pairs as the force loop reads them, i <= j, one array a component. A block of grains owns the
/// pairs whose first grain it owns; they stand together in order, and are padded to whole vectors with pairs of
/// a grain and its own image one cell away, of no size, which no grain sums.
template <int Dim>
class HotPairs {
 public:
  using Component = std::vector<double>;

  Component viscous;  ///< dashpot forces of the step before (force); empty where the law has none
  /// What the law remembers, at the places of MemoryLayout; empty at places of which it remembers nothing.
  std::array<Component, MemoryLayout<Dim>::kSize> memory;

  HotPairs() = default;
  HotPairs(HotPairs&&) = default;  // no copies: the plans point into the arrays
  HotPairs& operator=(HotPairs&&) = default;
  /// @param pairs  sorted, of the grains whose radii and masses are given in the order of the hot grains
  HotPairs(const std::vector<NeighborPair<Dim>>& pairs, const std::vector<double>& radius,
           const std::vector<double>& mass, const AnyContactLaw& law, double time_step);

  /// Pairs and padding.
  int size() const { return static_cast<int>(i_.size()); }
  bool padding(int p) const { return radii_[p] == 0.0; }
  int first_of_block(int b) const { return first_of_block_[b]; }
  int i(int p) const { return i_[p]; }
  int j(int p) const { return j_[p]; }
  NeighborPair<Dim> key(int p) const;
  double radii(int p) const { return radii_[p]; }
  /// Where a pair stands, -1 where it is not in the list.
  int find(const NeighborPair<Dim>& key) const;
  /// Takes over the memory of an older list of the same grains.
  void inherit(const HotPairs& old);

  PairArrays<Dim> arrays();
  const BlockSumsPlan& plan(int block) const { return plans_[block]; }

 private:
  /// For each grain, where the rows begin of the pairs that it is the first, or the second, of.
  struct RowsOfGrains {
    std::vector<int> first;  ///< of each grain in `row`, and the end
    std::vector<int> row;
    int count(int grain) const { return first[grain + 1] - first[grain]; }
  };

  void add(const NeighborPair<Dim>& key, double radius_i, double radius_j, double damping);
  Component reduced(const std::vector<double>& of_grain) const;
  void pad_block();
  void fill_pack();
  RowsOfGrains rows_of(const std::vector<int>& grain_of_pair, int n_grains) const;
  void plan_sums(int n_grains);
  void plan_block(int block, const RowsOfGrains& as_i, const RowsOfGrains& as_j);
  void plan_crossings();

  int row_size_ = 0;  ///< doubles
  std::vector<int> i_, j_;
  std::array<Component, Dim> image_;
  Component radii_, share_i_, damping_, row_;
  Component reduced_radius_, reduced_mass_;  ///< empty where the law does not need them
  std::vector<int> first_of_block_;
  std::vector<int> first_of_i_, end_of_i_;  ///< pairs of a grain

  std::vector<BlockSumsPlan> plans_;
  std::vector<int> listed_rows_, crossing_;  ///< what the plans point into
};

}  // namespace floc
