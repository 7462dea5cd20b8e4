#pragma once

#include <limits>
#include <string>

#include "floc/network/contact_network.h"

namespace floc {

/// Bounds on the bulk and shear moduli of a network (docs/physics.md, "Bounds"), as stress
/// (force/length^(Dim-1)).
struct Bounds {
  /// Stiffness of affine motion without rotations: the sum over contacts of K_N r^2/(Dim^2 V), with the branch length r
  /// and the volume V, and the analogous sum for shear. Upper bounds on B_C and on G = (C11 + C22 - 2 C12)/4 (in 3D the
  /// mean of G over the three pairs of axes) where the network is stable.
  double B_voigt = 0.0;
  double G_voigt = 0.0;
  /// V P^2/sum(F_N^2/K_N + F_T^2/K_T + Gamma^2/K_R), with the forces that the state carries; attractions across a gap
  /// are left out of the sum. 0 at P = 0. A lower bound on the strain-controlled bulk modulus B_C where `fault` is
  /// empty, by the inequality of Cauchy and Schwarz (1.sigma)^2 <= (1.C 1) (sigma.S sigma) with the compliance S. If
  /// the stress is isotropic, it is also a lower bound on the stress-controlled modulus B_S.
  double B_reuss = 0.0;
  /// Reason why B_reuss <= B_C <= B_voigt is not guaranteed, as a clause after "because". Empty if the inequality is a
  /// theorem: no force acts across a gap, no stiffness is negative, and the forces balance.
  std::string fault;
  /// Mean-field forms of the bounds as printed in [GRC2008]: averages of products are replaced by products of averages.
  double B_voigt_printed = 0.0;
  double G_voigt_printed = 0.0;
  double B_reuss_printed = 0.0;
  /// Ratio `<F_N^2 + (K_N/K_T) F_T^2 + (K_N/K_R) Gamma^2>/<F_N>^2` of averages over touching contacts; the printed
  /// B_reuss is inversely proportional to it. Infinite if `<F_N>` = 0 or if no grains touch.
  double Z2 = std::numeric_limits<double>::infinity();
};

/// Averages over a packing that the mean-field forms of the bounds need and that do not follow from its contact
/// network.
struct MeanField {
  double
      coordination;  ///< coordination number z: touching contacts per grain, each contact counted at both grains
  double solid_fraction;  ///< solid fraction Phi
};

/// Computes the bounds on the moduli of a network from the stiffnesses and forces of its contacts.
/// @param pressure    P, mean of the diagonal of the static stress (force/length^(Dim-1))
/// @param mean_field  averages for the `*_printed` forms
template <int Dim>
Bounds elastic_bounds(const ContactNetwork<Dim>& network, double pressure, const MeanField& mean_field);

}  // namespace floc
