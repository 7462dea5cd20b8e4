#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Numbers and mean forces of three groups of bonds: in compression, in tension, and with a normal force F_N near zero.
/// A bond is any interaction of two grains, including attraction across a gap; contacts with walls are left out. The
/// coordination number z of a group is twice the number of bonds divided by the number of grains.
struct BondSigns {
  int n_bonds = 0;
  double z = 0.0;
  double z_plus = 0.0;   ///< coordination number of bonds in compression, without bonds near zero
  double z_minus = 0.0;  ///< coordination number of bonds in tension, without bonds near zero
  double z_near = 0.0;   ///< coordination number of bonds with |F_N| < `near`
  /// Number of bonds in tension divided by the number of bonds in compression or tension; 0 without such bonds.
  double minus_share = 0.0;
  double mean_plus = 0.0, mean_minus = 0.0;  ///< mean |F_N| of the bonds in compression and in tension (force)
};

/// Counts the bonds by the sign of their normal force F_N.
/// @param near  limit >= 0 (force), otherwise InputError; a force counts as near zero if |F_N| < near
template <int Dim>
BondSigns bond_signs(const Packing<Dim>& packing, double near);

/// Returns the tensile strength of a packing (stress): the tension at which the packing would break if the force of
/// every bond reached the pull-off force F0 at the same time. With the coordination number z, the solid fraction Phi
/// and the diameter d, this strength is
///
///   z Phi F0/(pi d^(Dim-1)),
///
/// which is the virial stress of equal grains that touch. This formula is exact for a crystal. For z = pi/(1 - Phi), it
/// gives Rumpf's estimate of the tensile strength.
/// @param F0  pull-off force (force)
/// @param d   diameter (length)
double virial_strength(int dimension, double z, double solid_fraction, double F0, double d);

/// Returns Rumpf's estimate of the tensile strength (stress), Phi/(1 - Phi) F0/d^(Dim-1), where Phi is the solid
/// fraction. This estimate equals virial_strength() for the coordination number pi/(1 - Phi).
/// @param F0  pull-off force (force)
/// @param d   diameter (length)
double rumpf_strength(int dimension, double solid_fraction, double F0, double d);

}  // namespace floc
