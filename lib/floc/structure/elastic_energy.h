#pragma once

#include <optional>

#include "floc/packing/law/contact_energy.h"
#include "floc/packing/packing.h"

namespace floc {

/// Returns the energy of the contacts of a packing, per grain (energy); 0 without grains.
template <int Dim>
double elastic_energy_per_grain(const Packing<Dim>& packing);

/// Returns the largest pressure in the contact of two spheres according to Hertz, 3 N/(2 pi R* h) with 1/R* =
/// 1/Ri + 1/Rj, in the middle of a disk of radius sqrt(R* h) (force/length^2).
/// @param N  elastic normal force   @param h  overlap (length), > 0   @param R  R* (length), > 0
double hertz_contact_pressure(double N, double h, double R);

/// Returns the largest hertz_contact_pressure() over the contacts of a packing of spheres; nothing if there is
/// no contact, or if some contact is not one of Hertz (a Hertz contact has 2 K_N h = 3 N).
std::optional<double> largest_contact_pressure(const Packing<3>& packing);

}  // namespace floc
