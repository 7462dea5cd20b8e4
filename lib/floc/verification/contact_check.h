#pragma once

#include <string>
#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Returns the law of a contact: the law between grains, or that of the walls.
template <int Dim>
const Law& law_of(const Packing<Dim>& packing, const Contact<Dim>& contact) {
  return packing.is_wall(contact.j) ? packing.wall_law : packing.law;
}

/// Returns the largest error of a distance by rounding of the positions, their differences and the radii (length).
template <int Dim>
double distance_error(const Packing<Dim>& packing);

/// Returns the pairs of grains, or of a grain and a wall, that are missing among the contacts: they overlap by more
/// than `open` (length), or are inside the range of their law by more than that. Their gap and normal are set.
template <int Dim>
std::vector<Contact<Dim>> missing_contacts(const Packing<Dim>& packing, double open);

/// Numbers of contacts by kind, and differences of their forces from the law.
struct ContactCheck {
  int n_contacts = 0;
  int n_with_gap = 0;               ///< contacts taken as touching whose surfaces are apart
  int n_distant = 0;                ///< attractions across a gap
  int n_pulling = 0;                ///< normal force below zero, beyond rounding
  int n_mobilised = 0;              ///< mobilised: sliding, or yielding in rolling or twisting
  int n_beyond_cap = 0;             ///< tangential force or rolling moment above its limit
  int n_different = 0;              ///< normal force differs from the law's
  double largest_difference = 0.0;  ///< largest difference of normal forces, relative to their mean size
  std::string most_different;       ///< grains of the contact with that difference
  int n_missing = 0;                ///< pairs that touch and are not listed
  std::string missing;              ///< the first missing pair
};

/// Checks the forces of a packing against its law and its contacts against its geometry. The normal force of a
/// contact with its own stiffness (linear law) is compared with this stiffness times its overlap.
/// @param tolerance  smallest difference that counts, relative to the mean size of the normal forces; differences
/// that rounding of the positions explains never count
template <int Dim>
ContactCheck check_contacts(const Packing<Dim>& packing, double tolerance);

/// Adds pairs that touch but are not among the contacts to `check`, for contacts that do not come from the geometry.
template <int Dim>
void add_missing_contacts(const Packing<Dim>& packing, ContactCheck& check);

}  // namespace floc
