#pragma once

#include <string>
#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Returns a bound (length) on the rounding error of the distance between two grains. The positions of the grains, the
/// difference of these positions, and the radii are rounded.
template <int Dim>
double distance_error(const Packing<Dim>& packing);

/// Returns distance_error() divided by the diameter of the smallest grain.
template <int Dim>
double relative_distance_error(const Packing<Dim>& packing);

/// Returns the pairs of grains, and pairs of a grain and a wall, that interact but are missing in the contact list. A
/// pair is returned only if its gap (negative for an overlap) is smaller than the range of the contact law minus `open`
/// (length). The gap and the normal of each returned contact are set.
template <int Dim>
std::vector<Contact<Dim>> missing_contacts(const Packing<Dim>& packing, double open);

/// Result of check_contacts(): numbers of contacts with certain properties, and differences between the contact forces
/// and those of the contact law.
struct ContactCheck {
  int n_contacts = 0;
  /// Number of contacts that are marked as touching although their surfaces have a gap.
  int n_with_gap = 0;
  int n_bonds = 0;      ///< number of bonds, whose forces do not follow from the law
  int n_distant = 0;    ///< number of contacts whose surfaces attract each other across a gap
  int n_pulling = 0;    ///< number of contacts whose normal force is tensile, beyond rounding errors
  int n_mobilised = 0;  ///< number of contacts that slide, or that yield in rolling or twisting
  /// Number of contacts whose tangential force, rolling moment or twisting moment exceeds its limit in the contact law.
  int n_beyond_cap = 0;
  int n_different = 0;  ///< number of contacts whose normal force differs from that of the contact law
  /// Largest difference between a normal force and that of the contact law, divided by the mean absolute value of the
  /// normal forces.
  double largest_difference = 0.0;
  /// names of the grains of the contact with this largest difference
  std::string most_different;
  int n_missing = 0;    ///< number of pairs that touch but are missing in the contact list
  std::string missing;  ///< text with the names of the grains and the gap of the first missing pair
};

/// Checks the contact forces of a packing against its contact law, and its contacts against the positions of the
/// grains. If the law is linear and each contact has its own stiffness, the normal force of a contact is compared with
/// the product of the stiffness and the overlap of the contact.
/// @param tolerance  accepted difference between a normal force and the force of the law, divided by the mean absolute
/// value of the normal forces. Differences that rounding of the positions can explain are accepted, too
template <int Dim>
ContactCheck check_contacts(const Packing<Dim>& packing, double tolerance);

/// Adds to `check` the pairs of grains that touch but are missing in the contact list. This check is useful if the list
/// was read from a file and not computed from the positions.
template <int Dim>
void add_missing_contacts(const Packing<Dim>& packing, ContactCheck& check);

}  // namespace floc
