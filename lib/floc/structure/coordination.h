#pragma once

#include <cstdint>

#include "floc/packing/packing.h"

namespace floc {

/// Numbers of contacts between the N grains of a packing (docs/physics.md, "Coordination and rattlers"). A coordination
/// number is twice the number of contacts between grains that touch, divided by N. Attractions across a gap are counted
/// separately. [GRC2008] includes them in z and z_minus; for a comparison, 2 n_distant/N must be added to both.
struct Coordination {
  int n_contacts = 0;    ///< number of contacts between grains that touch
  int n_distant = 0;     ///< number of pairs of grains that attract each other across a gap
  double z = 0.0;        ///< coordination number 2 n_contacts/N, with N the number of grains
  double z_plus = 0.0;   ///< coordination number of contacts in compression: twice their number divided by N
  double z_minus = 0.0;  ///< coordination number of contacts in tension: twice their number divided by N
  /// Coordination number of contacts whose normal force is at most `zero_force`, the argument of coordination().
  double z_zero = 0.0;
  int n_rattlers = 0;
  double rattler_fraction = 0.0;  ///< x0: share of grains that are rattlers (carry no force)
  /// Coordination number without rattlers: twice the number of contacts between grains that are not rattlers, divided
  /// by the number of these grains.
  double z_star = 0.0;
  double x22 = 0.0;  ///< share of contacts between two grains that have exactly two contacts each
};

/// Counts the contacts of a packing.
/// @param zero_force  largest normal force that counts as zero (force), >= 0; otherwise InputError
template <int Dim>
Coordination coordination(const Packing<Dim>& packing, double zero_force);

/// Returns the number of pairs of grains in the list of contacts; several contacts of one pair count as one.
template <int Dim>
std::int64_t n_touching_pairs(const Packing<Dim>& packing);

}  // namespace floc
