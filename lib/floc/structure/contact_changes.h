#pragma once

#include <string>
#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// A contact that two states share: its index in the contact list of each.
struct KeptContact {
  int before;
  int after;
};

/// Changes of contacts and positions between two states of the same grains. Contacts are surfaces that touch;
/// attractions across a gap do not count.
template <int Dim>
struct ContactChanges {
  std::vector<KeptContact> kept;
  std::vector<int> lost;    ///< indices in the contact list before
  std::vector<int> gained;  ///< indices in the contact list after
  int n_parted = 0;         ///< lost contacts that are now attractions across a gap
  /// Deformation of the cell: the affine part takes x to deformation * x. Identity - deformation is the strain,
  /// shortening positive.
  Mat<Dim> deformation = Mat<Dim>::Identity();
  /// Displacement of each grain without the affine part and the mean (length).
  std::vector<Vec<Dim>> displacement;
  /// Cell vectors by which each grain was moved back into the cell: after, it is at
  /// deformation * x before + displacement + (the mean) + wrapped * cell.
  std::vector<Vec<Dim, int>> wrapped;
  /// The lattice vectors after that correspond to those before, one per row.
  Mat<Dim> cell_after = Mat<Dim>::Identity();

  int n_before() const { return static_cast<int>(kept.size() + lost.size()); }
  int n_after() const { return static_cast<int>(kept.size() + gained.size()); }
  double rms_displacement() const;      ///< (length)
  double largest_displacement() const;  ///< (length)
};

/// Returns the reason why two packings cannot be compared (walls, different numbers or sizes of grains, or
/// lattices that do not correspond), or an empty string if they can.
template <int Dim>
std::string incomparable(const Packing<Dim>& before, const Packing<Dim>& after);

/// Compares two states. Grains are identified by their index, contacts by both grains, image and key.
/// Displacements are taken to the nearest image in reduced coordinates, so grains must move less than half the
/// cell relative to their mean. Neither a common translation nor another choice of lattice vectors changes the
/// result.
/// @pre incomparable(before, after) is empty
template <int Dim>
ContactChanges<Dim> contact_changes(const Packing<Dim>& before, const Packing<Dim>& after);

}  // namespace floc
