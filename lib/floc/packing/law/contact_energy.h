#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Returns the energy of a spring, force^2/(2 stiffness); 0 if the stiffness is zero.
inline double spring_energy(double squared_force, double stiffness) {
  return stiffness > 0.0 ? 0.5 * squared_force / stiffness : 0.0;
}

/// Potential energy of a contact (energy).
struct ContactEnergy {
  /// Elastic energy N^2 h/(N + K_N h) + T^2/(2 K_T) + M^2/(2 K_R) of the elastic normal force N at the overlap
  /// h, the tangential force T and the moment M of the rolling spring, with the stiffnesses K_N, K_T and K_R;
  /// the twisting spring has a similar term. The first term is the integral of N over h if N follows a power of
  /// h: N h/2 for linear contacts, (2/5) N h for Hertz contacts. Other laws compute it from the gap and the
  /// history. The elastic energy of a distant attraction is zero.
  double elastic = 0.0;
  double normal = 0.0;  ///< energy of the normal force, the first term of `elastic`, which includes it
  /// Energy of the adhesion, negative where the surfaces attract each other.
  double attraction = 0.0;

  double all() const { return elastic + attraction; }
};

template <int Dim>
ContactEnergy contact_energy(const Packing<Dim>& packing, const Contact<Dim>& contact);

/// Returns the sum of the energies of all contacts of a packing.
template <int Dim>
ContactEnergy contact_energy(const Packing<Dim>& packing);

/// Returns the kinetic energy of the translations of the grains divided by the elastic energy of all contacts;
/// infinite if grains move and no contact is loaded, zero if nothing moves.
template <int Dim>
double kinetic_over_elastic_energy(const Packing<Dim>& packing);

}  // namespace floc
