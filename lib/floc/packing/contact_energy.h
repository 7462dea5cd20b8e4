#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Elastic energy of one contact (energy):
///
///   N^2 h/(N + K_N h) + T^2/(2 K_T) + M^2/(2 K_R),   N elastic normal force, h overlap
///
/// The first term is the integral of N over h wherever N follows a power of h: N h/2 for linear contacts, (2/5)
/// N h for Hertz contacts. Adhesion is left out; a distant attraction has no such energy.
template <int Dim>
double elastic_energy(const Contact<Dim>& contact);

/// Kinetic energy of the translations of the grains over the elastic energy of all contacts; infinite where
/// grains move and no contact is loaded, zero where nothing moves.
template <int Dim>
double kinetic_over_elastic_energy(const Packing<Dim>& packing);

}  // namespace floc
