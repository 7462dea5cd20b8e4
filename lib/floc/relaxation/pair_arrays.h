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

/// Corrects a damping coefficient c for the lag of the dashpot force, which acts kDashpotLag time steps too late.
/// Without the correction, the lag would multiply the damping by exp(kDashpotLag c dt/(2 m_eff)), to second order in
/// the time step dt, with the effective mass m_eff. For example, with a lag of half a step and time steps of 0.1
/// sqrt(m/K_N), where m is the mass of a grain and K_N the normal stiffness, a nominal restitution of 0.015 would
/// become 0.006. A coefficient that follows the contact stiffness varies during the motion and is not corrected.
inline double lagging_damping(double coefficient, double effective_mass, double time_step) {
  return coefficient * std::exp(-0.5 * kDashpotLag * coefficient * time_step / effective_mass);
}

/// Neighbouring pairs of bodies in the form that the force loop reads, with one array per component: pairs of grains
/// with indices i <= j, or pairs of a grain i and a wall j. Grains form blocks of kGrainBlock, and a pair belongs to
/// the block of its first grain. The pairs are sorted, so that the pairs of a block are contiguous. The pairs of each
/// group of blocks are padded to whole vector registers with pairs that have no effect: a grain with a far image of
/// itself, or a grain with a wall (the force of this pair is not summed). If all grains are equal, numbers that follow
/// from their sizes are stored once for all pairs.
template <int Dim>
class PairArrays {
 public:
  using Component = AlignedVector<double>;

  /// Dashpot force of each pair in the previous time step; empty if the contact law has no damping.
  Component viscous;
  /// History variables of the pairs, one array per variable of HistoryLayout. The array of a variable that the contact
  /// law does not use is empty.
  std::array<Component, HistoryLayout<Dim>::kSize> history;

  PairArrays() = default;
  /// @param pairs  sorted pairs, in which a grain is given by its place in `grains`
  /// @param blocks_of_group  number of consecutive blocks of grains whose pairs are computed, and padded, together
  PairArrays(const std::vector<NeighborPair<Dim>>& pairs, Partner partner, const GrainArrays<Dim>& grains,
             const ComposedLaw& law, double time_step, int blocks_of_group);

  /// Returns the number of pairs, including padding pairs.
  int size() const { return static_cast<int>(i_.size()); }
  bool padding(int p) const { return image_[0][p] == kPaddingImage; }
  int first_of_block(int b) const { return first_of_block_[b]; }
  int i(int p) const { return i_[p]; }
  int j(int p) const { return j_[p]; }
  NeighborPair<Dim> key(int p) const;
  /// Returns the second and later contacts of any two bodies: the pairs whose key is not 0. (The first contact of two
  /// bodies has the key 0.)
  std::vector<NeighborPair<Dim>> further_contacts() const;
  double radii(int p) const { return radii_[p & own_numbers_]; }
  /// Returns the index of a pair in these arrays; -1 if they do not contain the pair.
  int find(const NeighborPair<Dim>& key) const;
  /// Copies the history variables and dashpot forces of those pairs that are also in an older list of the same grains.
  void inherit(const PairArrays& old);
  /// Frees the arrays that are needed only to compute forces.
  /// @pre no later time step uses these pairs
  void drop_numbers();
  /// Frees the dashpot forces and all arrays that are needed only to compute forces (drop_numbers()), but keeps the
  /// history variables of the pairs.
  void keep_history_alone();
  /// Recomputes the parameters of the liquid bridges from their volumes, which are history variables of the pairs. Does
  /// nothing if the contact law has no liquid.
  void refresh_bridges(const ComposedLaw& law);
  /// Volumes of the liquid bridges (length^3), negative for broken bridges; empty if the contact law has no liquid.
  Component& bridge_volume();
  const Component& bridge_volume() const;

  /// Returns pointers to these arrays for the kernels (compiled loops over pairs). PairView::row, the pointer to the
  /// memory into which the kernels write forces and moments, is not set: this memory belongs to class RowSums.
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
  int own_numbers_ = -1;  ///< 0 if all pairs share their numbers, otherwise -1 (PairView::own_numbers)
  int blocks_of_group_ = 1;
  AlignedVector<int> i_, j_;
  /// Periodic image of the second grain of each pair: number of lattice vectors along each axis (whole numbers).
  std::array<AlignedVector<float>, Dim> image_;
  std::vector<int> key_;  ///< keys of all pairs (NeighborPair::key); empty if all keys are 0
  Component radii_, share_i_, damping_;
  /// Reduced radius and mass of each pair; empty if the contact law does not need them.
  Component reduced_radius_, reduced_mass_;
  /// Radii of the two grains and parameters of the liquid bridge of each pair; empty if the contact law has no liquid.
  Component radius_i_, radius_j_, strength_, decay_, reach_;
  std::vector<int> first_of_block_;
  /// For each grain i: index of the first pair whose first grain is i, and index after the last of these pairs.
  std::vector<int> first_of_i_, end_of_i_;
};

}  // namespace floc
