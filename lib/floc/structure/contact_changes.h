#pragma once

#include <string>
#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// A contact that exists in two states, with its index in the contact list of each state.
struct KeptContact {
  int before;
  int after;
};

/// Changes of the contacts and of the grain positions of a packing from a state before to a state after. Only grains
/// that touch are in contact; attraction across a gap does not count.
template <int Dim>
struct ContactChanges {
  std::vector<KeptContact> kept;
  std::vector<int> lost;    ///< indices of the lost contacts in the contact list of the state before
  std::vector<int> gained;  ///< indices of the gained contacts in the contact list of the state after
  /// Number of lost contacts whose grains attract each other across a gap in the state after.
  int n_parted = 0;
  /// Deformation gradient of the cell: the affine displacement takes x to deformation * x. The strain is
  /// Identity - deformation, with shortening positive.
  Mat<Dim> deformation = Mat<Dim>::Identity();
  /// Displacement of each grain (length), minus the affine displacement, minus the mean of this difference over all
  /// grains.
  std::vector<Vec<Dim>> displacement;
  /// Numbers of lattice vectors by which each grain was moved back into the cell. The position in the state after is
  /// deformation * (position before) + displacement + wrapped * cell_after, plus a translation common to all grains.
  std::vector<Vec<Dim, int>> wrapped;
  /// Lattice vectors of the state after, one per row. Row a is the deformed lattice vector a of the state before, even
  /// if the state after was stored with other lattice vectors.
  Mat<Dim> cell_after = Mat<Dim>::Identity();

  int n_before() const { return static_cast<int>(kept.size() + lost.size()); }
  int n_after() const { return static_cast<int>(kept.size() + gained.size()); }
  double rms_displacement() const;      ///< root mean square of `displacement` (length)
  double largest_displacement() const;  ///< largest `displacement` (length)
};

/// Returns the reason why two packings cannot be compared, or an empty text if they can. Reasons are walls, different
/// numbers, sizes or kinds of grains, and lattices that no strain transforms into each other.
template <int Dim>
std::string incomparable(const Packing<Dim>& before, const Packing<Dim>& after);

/// Compares two states of a packing. Grains are identified by their index, contacts by their two grains, periodic image
/// and key. All contact points of two grains with corners count as one contact, with the index of the first point. The
/// displacement of a grain goes to the nearest of its periodic images in the state after (in reduced coordinates).
/// Relative to the mean displacement, each grain must therefore move by less than half the cell. A common translation
/// of all grains, or another choice of lattice vectors, does not change the result.
/// @pre incomparable(before, after) is empty
template <int Dim>
ContactChanges<Dim> contact_changes(const Packing<Dim>& before, const Packing<Dim>& after);

}  // namespace floc
