#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Bonds between grains by the sign of their normal force: every interaction, attractions across gaps included.
/// Bonds whose force is near zero are a class of their own. Each number z is twice the number of bonds over the
/// number of grains. Contacts with walls are left out.
struct BondSigns {
  int n_bonds = 0;
  double z = 0.0;
  double z_plus = 0.0;   ///< in compression
  double z_minus = 0.0;  ///< in tension
  double z_near = 0.0;   ///< near zero, |F_N| < near
  /// Share of bonds in tension among those that are not near zero; 0 without any.
  double minus_share = 0.0;
  double mean_plus = 0.0, mean_minus = 0.0;  ///< |F_N| of the two classes (force)
};

/// Counts the bonds by sign. @param near  normal forces below this are near zero (force), >= 0; otherwise
/// InputError
template <int Dim>
BondSigns bond_signs(const Packing<Dim>& packing, double near);

/// Returns the tension at which a packing would part if every bond carried its pull-off force at once, minus P
/// at failure (stress):
///
///   z Phi F0/(pi d^(Dim-1)),
///
/// the virial of z bonds per grain between equal grains that touch, exact for a crystal. Rumpf's estimate of
/// the tensile strength takes z = pi/(1 - Phi) in it.
/// @param F0  pull-off force (force)   @param d  diameter (length)
double virial_strength(int dimension, double z, double solid_fraction, double F0, double d);

/// Returns Rumpf's estimate of the tensile strength (stress), which is virial_strength() with z = pi/(1 - Phi):
/// Phi/(1 - Phi) F0/d^(Dim-1).
double rumpf_strength(int dimension, double solid_fraction, double F0, double d);

}  // namespace floc
