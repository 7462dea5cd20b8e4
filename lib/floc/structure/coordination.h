#pragma once

#include <cstdint>

#include "floc/packing/packing.h"

namespace floc {

/// Numbers of contacts between the N grains of a packing (docs/physics.md, "Coordination and rattlers"). A coordination
/// number is twice a number of contacts divided by N. Contacts are pairs of grains that touch. Pairs that attract each
/// other across a gap are counted separately, but [GRC2008] includes them in z and z_minus. For a comparison, 2
/// n_distant/N must be added to both.
struct Coordination {
  int n_contacts = 0;    ///< number of contacts between grains that touch
  int n_distant = 0;     ///< number of pairs of grains that attract each other across a gap
  double z = 0.0;        ///< coordination number 2 n_contacts/N, with N the number of grains
  double z_plus = 0.0;   ///< coordination number of contacts in compression: twice their number divided by N
  double z_minus = 0.0;  ///< coordination number of contacts in tension: twice their number divided by N
  /// Coordination number of contacts with a normal force of at most `zero_force` in magnitude, see coordination().
  double z_zero = 0.0;
  int n_rattlers = 0;
  double rattler_fraction = 0.0;  ///< x0: share of grains that are rattlers (carry no force)
  /// Coordination number without rattlers: twice the number of contacts between grains that are not rattlers, divided
  /// by the number of these grains.
  double z_star = 0.0;
  double x22 = 0.0;  ///< share of the contacts whose two grains each have exactly two contacts
};

/// Counts the contacts of a packing.
/// @param zero_force  largest normal force that counts as zero (force), >= 0; otherwise InputError
template <int Dim>
Coordination coordination(const Packing<Dim>& packing, double zero_force);

/// Returns the number of pairs of grains in the contact list; several contacts of one pair count once.
template <int Dim>
std::int64_t n_touching_pairs(const Packing<Dim>& packing);

}  // namespace floc
