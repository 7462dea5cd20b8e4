#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "floc/base/aligned_vector.h"
#include "floc/contact/history.h"
#include "floc/neighbors/pairs.h"
#include "floc/relaxation/grain_arrays.h"
#include "floc/relaxation/kernels/step_kernels.h"
#include "floc/relaxation/partner.h"

namespace floc {

struct ComposedLaw;

/// Dashpot coefficient to use where the force lags by kDashpotLag steps. The lag increases the damping by the
/// factor exp(lag c dt/(2 m_eff)) to second order in the step; without this correction a restitution of 0.015
/// comes out as 0.006 at a tenth of sqrt(m/K_N) and half a step of lag. A coefficient that follows the
/// stiffness varies in motion and is not corrected.
inline double lagging_damping(double coefficient, double effective_mass, double time_step) {
  return coefficient * std::exp(-0.5 * kDashpotLag * coefficient * time_step / effective_mass);
}

/// Neighbour pairs as the force loop reads them, one array per component: pairs of grains i <= j, or of a grain
/// i and a wall j. A block of grains owns the pairs whose first grain it owns; these are contiguous and in
/// order. The pairs of each group of blocks are padded to whole vectors with pairs that no grain sums: of a
/// grain and its own image far away, or of a grain and a wall. Where all grains are equal, numbers that follow
/// from their sizes are stored once for all pairs.
template <int Dim>
class PairArrays {
 public:
  using Component = AlignedVector<double>;

  Component viscous;  ///< dashpot forces of the step before (force); empty where the law has none
  /// History of the pairs, one array per place of the layout; empty at places that the law does not use.
  std::array<Component, HistoryLayout<Dim>::kSize> history;

  PairArrays() = default;
  /// @param pairs            sorted, of grains by their places among `grains`
  /// @param blocks_of_group  blocks whose pairs are always computed together, and padded together
  PairArrays(const std::vector<NeighborPair<Dim>>& pairs, Partner partner, const GrainArrays<Dim>& grains,
             const ComposedLaw& law, double time_step, int blocks_of_group);

  /// Number of pairs, with padding.
  int size() const { return static_cast<int>(i_.size()); }
  bool padding(int p) const { return image_[0][p] == kPaddingImage; }
  int first_of_block(int b) const { return first_of_block_[b]; }
  int i(int p) const { return i_[p]; }
  int j(int p) const { return j_[p]; }
  NeighborPair<Dim> key(int p) const;
  /// Pairs whose key is not 0: further contacts of the two bodies of another pair.
  std::vector<NeighborPair<Dim>> further_contacts() const;
  double radii(int p) const { return radii_[p & own_numbers_]; }
  /// Index of a pair, -1 where it is not in the list.
  int find(const NeighborPair<Dim>& key) const;
  /// Takes over the history of an older list of the same grains.
  void inherit(const PairArrays& old);
  /// Drops the numbers that only the computation of forces reads. @pre no step uses this list again
  void drop_numbers();
  /// Drops the numbers that drop_numbers() drops, and the dashpot forces that another list would inherit.
  void keep_history_alone();
  /// Recomputes the parameters of the liquid bridges from the volumes in the history; does nothing under laws
  /// without liquid.
  void refresh_bridges(const ComposedLaw& law);
  /// Volumes of the liquid bridges (length^3), signed as in the history; empty where the law has no liquid.
  Component& bridge_volume();
  const Component& bridge_volume() const;

  /// View without rows, which belong to all lists together (row_sums.h).
  PairView<Dim> view();

 private:
  static constexpr float kPaddingImage = 1 << 20;

  void reserve(std::size_t n_pairs);
  void add(const NeighborPair<Dim>& key);
  void add_numbers(double radius_i, double radius_j, double damping);
  Component reduced(std::span<const double> of_grain) const;
  void keep_radii(std::span<const double> radius);
  void begin_block();
  void fill_pack();

  Partner partner_ = Partner::grain;
  int own_numbers_ = -1;  ///< PairView::own_numbers
  int blocks_of_group_ = 1;
  AlignedVector<int> i_, j_;
  std::array<AlignedVector<float>, Dim> image_;  ///< whole numbers
  std::vector<int> key_;                         ///< keys of all pairs; empty where all are 0
  Component radii_, share_i_, damping_;
  Component reduced_radius_, reduced_mass_;                   ///< empty where the law does not need them
  Component radius_i_, radius_j_, strength_, decay_, reach_;  ///< empty where the law holds no liquid
  std::vector<int> first_of_block_;
  std::vector<int> first_of_i_, end_of_i_;  ///< pairs of a grain
};

}  // namespace floc
