#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Counts of contacts (docs/physics.md, "Coordination and rattlers"). Coordination numbers are 2 Nc/N over
/// surfaces that touch; distant attractions are counted separately ([GRC2008] counts them in z and z-: to
/// compare, add 2 n_distant/N).
struct Coordination {
  int n_contacts = 0;    ///< surfaces that touch
  int n_distant = 0;     ///< attractions across a gap
  double z = 0.0;        ///< 2 n_contacts/N
  double z_plus = 0.0;   ///< of contacts in compression
  double z_minus = 0.0;  ///< of contacts in tension
  double z_zero = 0.0;   ///< of contacts whose normal force is zero within the tolerance
  int n_rattlers = 0;
  double rattler_fraction = 0.0;  ///< x0
  /// Coordination number of the grains that are not rattlers: twice the contacts between them per such grain.
  double z_star = 0.0;
  double x22 = 0.0;  ///< share of the contacts that join two grains with two contacts each
};

/// Counts the contacts of a packing.
/// @param zero_force  largest normal force that counts as zero (force), >= 0; otherwise InputError
template <int Dim>
Coordination coordination(const Packing<Dim>& packing, double zero_force);

}  // namespace floc
