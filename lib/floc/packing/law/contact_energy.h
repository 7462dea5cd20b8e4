#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Returns the energy of a spring, force^2/(2 stiffness); 0 if the stiffness is zero.
inline double spring_energy(double squared_force, double stiffness) {
  return stiffness > 0.0 ? 0.5 * squared_force / stiffness : 0.0;
}

/// Potential energy of a contact (energy).
struct ContactEnergy {
  /// Elastic energy of the normal force and of the springs: N^2 h/(N + K_N h) + T^2/(2 K_T) + M^2/(2 K_R), plus an
  /// analogous term for the twisting spring. Here N is the elastic normal force at the overlap h, T the tangential
  /// force and M the moment of the rolling spring; K_N, K_T and K_R are the normal, tangential and rolling stiffness.
  /// If N is proportional to a power of h, the first term is the integral of N over h: N h/2 for linear contacts, (2/5)
  /// N h for Hertz contacts. For all other laws, this term is computed from the gap and the history. The elastic energy
  /// of a distant attraction is zero. A bond is a spring: its first term is F_N^2/(2 K_N) with its normal force F_N.
  double elastic = 0.0;
  double normal = 0.0;  ///< elastic energy of the normal force, the first term of `elastic`
  /// Energy of the adhesion, negative where the surfaces attract each other; 0 for bonds.
  double attraction = 0.0;

  double all() const { return elastic + attraction; }
};

template <int Dim>
ContactEnergy contact_energy(const Packing<Dim>& packing, const Contact<Dim>& contact);

/// Returns the sum of the energies of all contacts of a packing.
template <int Dim>
ContactEnergy contact_energy(const Packing<Dim>& packing);

/// Returns the translational kinetic energy of all grains divided by the elastic energy of all contacts; infinite if
/// grains move and no contact has elastic energy, zero if no grain moves.
template <int Dim>
double kinetic_over_elastic_energy(const Packing<Dim>& packing);

}  // namespace floc
