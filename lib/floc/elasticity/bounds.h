#pragma once

#include <limits>
#include <string>

#include "floc/network/contact_network.h"

namespace floc {

/// Bounds on the bulk and shear moduli of a contact network (docs/physics.md, "Bounds"), in units of stress
/// (force/length^(Dim-1)).
struct Bounds {
  /// Voigt bounds: moduli if every grain follows the strain of the cell, without rotation. B_voigt is the sum over
  /// contacts of K_N r^2/(Dim^2 V), with the normal stiffness K_N, the distance r between the two centres and the
  /// volume V; G_voigt is the analogous sum for shear. In a stable network, B_voigt is an upper bound on the bulk
  /// modulus B_C under imposed strain, and G_voigt is an upper bound on the shear modulus G = (C11 + C22 - 2 C12)/4,
  /// where C is the matrix of moduli. In 3D, G is the mean of this expression over the three pairs of axes.
  double B_voigt = 0.0;
  double G_voigt = 0.0;
  /// Reuss bound V P^2/sum(F_N^2/K_N + F_T^2/K_T + Gamma^2/K_R), with the volume V and the pressure P. The sum over
  /// touching contacts contains the normal force F_N, the tangential force F_T, the rolling moment Gamma and, in 3D,
  /// the twisting moment, each squared and divided by its stiffness. The bound is 0 at P = 0. If `fault` is empty,
  /// B_reuss is a lower bound on the bulk modulus B_C under imposed strain, by the inequality of Cauchy and Schwarz. If
  /// the stress is also isotropic, B_reuss is a lower bound on the bulk modulus B_S under imposed stress.
  double B_reuss = 0.0;
  /// Reason why B_reuss <= B_C <= B_voigt is not guaranteed, as a clause that follows "because". Empty if the
  /// inequality is guaranteed. It is guaranteed if no force acts across a gap, no stiffness is negative, and the forces
  /// balance.
  std::string fault;
  /// Mean-field forms of B_voigt, G_voigt and B_reuss, as printed in [GRC2008]: averages of products are replaced by
  /// products of averages.
  double B_voigt_printed = 0.0;
  double G_voigt_printed = 0.0;
  double B_reuss_printed = 0.0;
  /// Ratio `<F_N^2 + (K_N/K_T) F_T^2 + (K_N/K_R) Gamma^2>/<F_N>^2` of averages over touching contacts, with the normal
  /// force F_N, the tangential force F_T, the rolling moment Gamma and their stiffnesses. B_reuss_printed is inversely
  /// proportional to this ratio. Infinite if `<F_N>` = 0 or if no grains touch.
  double Z2 = std::numeric_limits<double>::infinity();
};

/// Averages over a packing that are needed for the mean-field forms of the bounds. The contact network does not contain
/// them.
struct MeanField {
  double coordination;    ///< coordination number z: mean number of touching contacts of a grain
  double solid_fraction;  ///< solid fraction Phi: volume of the grains divided by the volume of the cell
};

/// Computes the bounds on the moduli of a network from the stiffnesses and forces of its contacts.
/// @param pressure    P, mean of the diagonal of the static stress (force/length^(Dim-1))
/// @param mean_field  averages over the packing, for `B_voigt_printed`, `G_voigt_printed` and `B_reuss_printed`
template <int Dim>
Bounds elastic_bounds(const ContactNetwork<Dim>& network, double pressure, const MeanField& mean_field);

}  // namespace floc
