#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Energy of a spring, force^2/(2 stiffness); 0 without stiffness.
inline double spring_energy(double squared_force, double stiffness) {
  return stiffness > 0.0 ? 0.5 * squared_force / stiffness : 0.0;
}

/// Potential energy of a contact (energy).
struct ContactEnergy {
  /// N^2 h/(N + K_N h) + T^2/(2 K_T) + M^2/(2 K_R) of the elastic normal force N, the overlap h and the springs. The
  /// first term is the integral of N over h wherever N follows a power of h: N h/2 for linear contacts, (2/5) N h for
  /// Hertz contacts. Other laws give it as a function of the gap and the history. It is zero for a distant
  /// attraction.
  double elastic = 0.0;
  double normal = 0.0;  ///< the first term of `elastic`, included there
  /// Energy of the adhesion, negative where it acts.
  double attraction = 0.0;

  double all() const { return elastic + attraction; }
};

template <int Dim>
ContactEnergy contact_energy(const Packing<Dim>& packing, const Contact<Dim>& contact);

/// Sum of the energies of all contacts.
template <int Dim>
ContactEnergy contact_energy(const Packing<Dim>& packing);

/// Kinetic energy of the translations of the grains over the elastic energy of all contacts; infinite where
/// grains move and no contact is loaded, zero where nothing moves.
template <int Dim>
double kinetic_over_elastic_energy(const Packing<Dim>& packing);

}  // namespace floc
