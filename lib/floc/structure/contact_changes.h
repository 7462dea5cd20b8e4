#pragma once

#include <string>
#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// A contact that exists in two states: its index in the contact list of the state before, and its index in the contact
/// list of the state after.
struct KeptContact {
  int before;
  int after;
};

/// Changes of a packing from a state before to a state after: changes of the contacts and of the positions of the
/// grains. Only grains that touch are in contact; attraction across a gap does not count.
template <int Dim>
struct ContactChanges {
  std::vector<KeptContact> kept;
  std::vector<int> lost;    ///< indices of the lost contacts in the contact list of the state before
  std::vector<int> gained;  ///< indices of the gained contacts in the contact list of the state after
  int n_parted = 0;         ///< number of lost contacts whose grains now attract each other across a gap
  /// Deformation gradient of the cell: the affine displacement takes x to deformation * x. The strain is
  /// Identity - deformation, with shortening positive.
  Mat<Dim> deformation = Mat<Dim>::Identity();
  /// Displacement of each grain minus its affine part and minus the mean displacement of all grains (length).
  std::vector<Vec<Dim>> displacement;
  /// Numbers of lattice vectors by which each grain was moved back into the cell. The position in the state after is
  /// deformation * (position before) + displacement + (mean displacement) + wrapped * cell_after.
  std::vector<Vec<Dim, int>> wrapped;
  /// Lattice vectors of the later state, one per row, chosen so that each corresponds to a lattice vector of the
  /// earlier state.
  Mat<Dim> cell_after = Mat<Dim>::Identity();

  int n_before() const { return static_cast<int>(kept.size() + lost.size()); }
  int n_after() const { return static_cast<int>(kept.size() + gained.size()); }
  double rms_displacement() const;      ///< root mean square of `displacement` (length)
  double largest_displacement() const;  ///< largest `displacement` (length)
};

/// Returns the reason why two packings cannot be compared (walls, different numbers or sizes of grains, or lattices
/// that do not correspond); empty if they can.
template <int Dim>
std::string incomparable(const Packing<Dim>& before, const Packing<Dim>& after);

/// Compares two states of a packing. Grains are identified by their index, contacts by their two grains, periodic image
/// and key. All contact points of two grains with corners count as one contact, with the index of the first point. Of
/// the periodic images of a grain after the change, the one nearest in reduced coordinates defines the displacement;
/// each grain must therefore move by less than half the cell relative to the mean displacement. A common translation of
/// all grains, or another choice of lattice vectors, does not change the result.
/// @pre incomparable(before, after) is empty
template <int Dim>
ContactChanges<Dim> contact_changes(const Packing<Dim>& before, const Packing<Dim>& after);

}  // namespace floc
