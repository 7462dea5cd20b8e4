#pragma once

#include "floc/network/contact_network.h"

namespace floc {

/// Mean-field estimates of the moduli of a network (force/length^(Dim-1)), from averages over its touching contacts
/// (docs/physics.md, "Bounds"). The estimates assume that the directions of contacts are isotropic, and that the
/// distance between the centres of touching grains does not depend on the contact force. Without contacts, all
/// estimates are zero.
struct MeanFieldEstimates {
  /// Bulk modulus if the grains follow the strain without rotation; `z Phi <K_N>/(3 pi a)` for equal spheres of
  /// diameter a, with the normal stiffness K_N, the coordination number z and the solid fraction Phi. Equal to
  /// Bounds::B_voigt_printed.
  double B_voigt = 0.0;
  double G_voigt_rough = 0.0;  ///< shear modulus of affine motion: (3/5)(1 + (3/2) K_T/K_N) B_voigt in 3D
  /// shear modulus of affine motion if the tangential stiffness K_T is zero: (3/5) B_voigt in 3D
  double G_voigt_smooth = 0.0;
  /// Reuss estimate of the bulk modulus, with the forces of the state as trial forces: `z Phi <F_N>^2/(3 pi a
  /// <F_N^2/K_N + F_T^2/K_T + Gamma^2/K_R>)` for equal spheres, with the normal force F_N, the tangential force F_T,
  /// the rolling moment Gamma and their stiffnesses. Unlike in Bounds::B_reuss_printed, K_N may differ between
  /// contacts.
  double B_reuss = 0.0;
  /// Ratio `<F_N^(5/3) (1 + (K_N/K_T) F_T^2/F_N^2)>/<F_N>^(5/3)` of averages over contacts with a normal force F_N > 0,
  /// with the tangential force F_T and the stiffnesses K_N and K_T. For Hertz contacts B_voigt/B_reuss = Z(1/3) Z_hat,
  /// with `Z(1/3) = <F_N^(1/3)>/<F_N>^(1/3)`.
  double Z_hat = 0.0;
};

/// Computes the mean-field estimates of the moduli of a network.
/// @param coordination    coordination number z: mean number of touching contacts of a grain
/// @param solid_fraction  solid fraction Phi: volume of the grains divided by the volume of the cell
template <int Dim>
MeanFieldEstimates mean_field_estimates(const ContactNetwork<Dim>& network, double coordination,
                                        double solid_fraction);

/// Mean-field estimates of the moduli of equal spheres with Hertz contacts. They are computed from given averages; no
/// packing is needed.
struct HertzMeanField {
  double kn_over_a = 0.0;  ///< mean normal stiffness `<K_N>` divided by the diameter a (force/length^2)
  /// bulk modulus (1/2) (z Phi E/(3 pi))^(2/3) P^(1/3) Z(1/3), with the symbols of hertz_mean_field()
  double B = 0.0;
  double G_rough = 0.0,
         G_smooth = 0.0;  ///< shear moduli with and without tangential stiffness of the contacts
};

/// Computes the mean-field estimates of the moduli of equal spheres with Hertz contacts.
/// @param coordination    coordination number z
/// @param solid_fraction  solid fraction Phi
/// @param E               Y/(1 - nu^2), with Young's modulus Y and Poisson's ratio nu of the material (force/length^2)
/// @param ratio           ratio K_T/K_N of tangential to normal stiffness
/// @param P               pressure, >= 0 (force/length^2)
/// @param Z_third         `Z(1/3) = <N^(1/3)>/<N>^(1/3)` for the normal forces N; 1 for equal forces (Walton)
HertzMeanField hertz_mean_field(double coordination, double solid_fraction, double E, double ratio, double P,
                                double Z_third = 1.0);

}  // namespace floc
