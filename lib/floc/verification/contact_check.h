#pragma once

#include <string>
#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// The law of a contact: that between grains, or that of the walls.
template <int Dim>
const Law& law_of(const Packing<Dim>& packing, const Contact<Dim>& contact) {
  return packing.is_wall(contact.j) ? packing.wall_law : packing.law;
}

/// How far a distance may be off by rounding: of the positions, their differences and the radii (length).
template <int Dim>
double distance_error(const Packing<Dim>& packing);

/// Pairs of grains, and of grains with walls, that overlap by more than `open` (length), or are within the
/// range of their law by more, but are not among the contacts; gap and normal are set.
template <int Dim>
std::vector<Contact<Dim>> missing_contacts(const Packing<Dim>& packing, double open);

/// What the contacts of a packing are, and how far their forces are from those that its law gives.
struct ContactCheck {
  int n_contacts = 0;
  int n_with_gap = 0;               ///< taken as touching, but their surfaces are apart
  int n_distant = 0;                ///< attractions across a gap
  int n_pulling = 0;                ///< normal force below zero, beyond rounding
  int n_at_cap = 0;                 ///< slide or yield
  int n_beyond_cap = 0;             ///< tangential force or rolling moment above its cap
  int n_different = 0;              ///< normal force differs from the law's
  double largest_difference = 0.0;  ///< of normal forces, over the mean of their sizes
  std::string most_different;       ///< the grains of that contact
  int n_missing = 0;                ///< pairs that touch and are not listed
  std::string missing;              ///< the first of them
};

/// Checks the forces of a packing against its law and its contacts against its geometry. The normal force of a
/// contact with a stiffness of its own (linear law) is compared with that stiffness times its overlap.
/// @param tolerance  difference that counts, over the mean size of the normal forces; what rounding of the
/// positions may cause never counts
template <int Dim>
ContactCheck check_contacts(const Packing<Dim>& packing, double tolerance);

/// Looks for pairs that touch and are not among the contacts, where these do not come from the geometry.
template <int Dim>
void add_missing_contacts(const Packing<Dim>& packing, ContactCheck& check);

}  // namespace floc
