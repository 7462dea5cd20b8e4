#pragma once

#include <limits>
#include <string>

#include "floc/network/contact_network.h"

namespace floc {

/// Bounds on the bulk and shear moduli of a network (docs/physics.md, "Bounds"), as stress
/// (force/length^(Dim-1)).
struct Bounds {
  /// Affine motion without rotations: sum K_N r^2/(Dim^2 V), and its shear analogue. Upper bounds on B_C and on
  /// G = (C11 + C22 - 2 C12)/4 (3D: its mean over the three pairs of axes) where the network is stable.
  double B_voigt = 0.0;
  double G_voigt = 0.0;
  /// V P^2/sum(F_N^2/K_N + F_T^2/K_T + Gamma^2/K_R) with the state's own forces; distant attractions are left
  /// out of the sum. 0 at P = 0. A lower bound on B_C where `fault` is empty, by the inequality of Cauchy and
  /// Schwarz (1.sigma)^2 <= (1.C 1) (sigma.S sigma), and on B_S where the stress is isotropic as well.
  double B_reuss = 0.0;
  /// Reason why B_reuss <= B_C <= B_voigt does not follow, as a clause after "because". Empty where the
  /// inequality is a theorem: nothing acts across a gap, no stiffness is negative, and the forces balance.
  std::string fault;
  /// Mean-field forms as printed in [GRC2008], averages of products replaced by products of averages.
  double B_voigt_printed = 0.0;
  double G_voigt_printed = 0.0;
  double B_reuss_printed = 0.0;
  /// `<F_N^2 + (K_N/K_T) F_T^2 + (K_N/K_R) Gamma^2>/<F_N>^2` over touching contacts; infinite where `<F_N>` = 0
  /// and where nothing touches.
  double Z2 = std::numeric_limits<double>::infinity();
};

/// Averages that the mean-field forms take beside the network.
struct MeanField {
  double coordination;    ///< coordination number z of touching contacts
  double solid_fraction;  ///< solid fraction Phi
};

/// Computes the bounds of a network from its own forces.
/// @param pressure    P, mean of the diagonal of the static stress (force/length^(Dim-1))
/// @param mean_field  averages for the `*_printed` forms
template <int Dim>
Bounds elastic_bounds(const ContactNetwork<Dim>& network, double pressure, const MeanField& mean_field);

}  // namespace floc
