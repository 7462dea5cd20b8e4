#pragma once

#include <string>
#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Returns the law of a contact: the law for contacts between grains, or the law for contacts of grains with walls.
template <int Dim>
const Law& law_of(const Packing<Dim>& packing, const Contact<Dim>& contact) {
  return packing.is_wall(contact.j) ? packing.wall_law : packing.law;
}

/// Returns the largest error of a distance between two grains (length) that results from rounding their positions, the
/// difference of these, and the radii.
template <int Dim>
double distance_error(const Packing<Dim>& packing);

/// Returns the pairs of grains, and pairs of a grain and a wall, that are missing in the contact list. These pairs
/// overlap by more than `open` (length), or their gap is smaller than the range of their law by more than `open`. Gap
/// and normal are set in the returned contacts.
template <int Dim>
std::vector<Contact<Dim>> missing_contacts(const Packing<Dim>& packing, double open);

/// Numbers of contacts of each kind, and differences between the forces of contacts and the contact law.
struct ContactCheck {
  int n_contacts = 0;
  /// number of contacts that are marked as touching although there is a gap between their surfaces
  int n_with_gap = 0;
  int n_distant = 0;    ///< number of attractions across a gap
  int n_pulling = 0;    ///< number of contacts whose normal force is tensile, beyond rounding errors
  int n_mobilised = 0;  ///< number of contacts that slide, or that yield in rolling or twisting
  /// number of contacts whose tangential force, rolling moment or twisting moment is above its limit
  int n_beyond_cap = 0;
  int n_different = 0;  ///< number of contacts whose normal force differs from the contact law
  /// largest difference of a normal force from the contact law, over the mean absolute value of the normal forces
  double largest_difference = 0.0;
  std::string most_different;  ///< names of the grains of the contact with the largest difference
  int n_missing = 0;           ///< number of pairs that touch but are missing in the contact list
  std::string missing;         ///< the first missing pair in words: names of its grains, and its gap
};

/// Checks the forces of a packing against its contact law, and its contacts against the positions of the grains. If the
/// law is linear and contacts have stiffnesses of their own, the normal force of a contact is compared with its
/// stiffness times its overlap.
/// @param tolerance  smallest difference that counts, relative to the mean absolute value of the normal forces;
/// differences that rounding of the positions explains never count
template <int Dim>
ContactCheck check_contacts(const Packing<Dim>& packing, double tolerance);

/// Adds the pairs that touch but are missing in the contact list to `check`. This check is useful for contact lists
/// that were read from a file and not found from the positions.
template <int Dim>
void add_missing_contacts(const Packing<Dim>& packing, ContactCheck& check);

}  // namespace floc
