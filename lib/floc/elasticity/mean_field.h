#pragma once

#include "floc/network/contact_network.h"

namespace floc {

/// Mean-field estimates of the moduli of a network from averages over its touching contacts, with the
/// directions of contacts taken as isotropic and their lengths as independent of forces (docs/physics.md,
/// "Bounds"), as stress (force/length^(Dim-1)). Zero without contacts.
struct MeanFieldEstimates {
  /// `z Phi <K_N>/(3 pi a)` for equal spheres: grains that follow the strain without turning. It is
  /// B_voigt_printed of Bounds.
  double B_voigt = 0.0;
  double G_voigt_rough = 0.0;   ///< shear modulus of affine motion: (3/5)(1 + (3/2) K_T/K_N) B_voigt in 3D
  double G_voigt_smooth = 0.0;  ///< shear modulus with K_T set to zero: (3/5) B_voigt in 3D
  /// `z Phi <F_N>^2/(3 pi a <F_N^2/K_N + F_T^2/K_T + Gamma^2/K_R>)` for equal spheres: the forces of the state
  /// as a trial. Unlike in B_reuss_printed of Bounds, K_N may differ from contact to contact.
  double B_reuss = 0.0;
  /// `<F_N^(5/3) (1 + (K_N/K_T) F_T^2/F_N^2)>/<F_N>^(5/3)` over contacts with F_N > 0. For Hertz contacts
  /// B_voigt/B_reuss = Z(1/3) Z_hat.
  double Z_hat = 0.0;
};

/// Computes the estimates of a network.
/// @param coordination  z of touching contacts   @param solid_fraction  Phi
template <int Dim>
MeanFieldEstimates mean_field_estimates(const ContactNetwork<Dim>& network, double coordination,
                                        double solid_fraction);

/// Estimates for equal spheres with Hertz contacts, from averages alone, without a packing.
struct HertzMeanField {
  double kn_over_a = 0.0;  ///< `<K_N>` over the diameter (force/length^2)
  double B = 0.0;          ///< (1/2) (z Phi E/(3 pi))^(2/3) P^(1/3) Z(1/3)
  double G_rough = 0.0, G_smooth = 0.0;
};

/// Computes the estimates for equal spheres with Hertz contacts.
/// @param E  E/(1 - nu^2) of the material (force/length^2)   @param ratio  K_T/K_N
/// @param P  pressure, >= 0   @param Z_third  `Z(1/3) = <N^(1/3)>/<N>^(1/3)`, 1 for equal forces (Walton)
HertzMeanField hertz_mean_field(double coordination, double solid_fraction, double E, double ratio, double P,
                                double Z_third = 1.0);

}  // namespace floc
