#pragma once

#include <optional>

#include "floc/packing/contact_energy.h"
#include "floc/packing/packing.h"

namespace floc {

/// Mean over the grains of a packing of the energy of its contacts (energy); 0 without grains.
template <int Dim>
double elastic_energy_per_grain(const Packing<Dim>& packing);

/// Largest pressure in the contact of two spheres by Hertz, 3 N/(2 pi R* h) with 1/R* = 1/Ri + 1/Rj, in
/// the middle of a disk of radius sqrt(R* h) (force/length^2).
/// @param N  elastic normal force   @param h  overlap (length), > 0   @param R  R* (length), > 0
double hertz_contact_pressure(double N, double h, double R);

/// Its largest value over the contacts of a packing of spheres; nothing where there is no contact or one that
/// is not Hertz's: one with 2 K_N h = 3 N is.
std::optional<double> largest_contact_pressure(const Packing<3>& packing);

}  // namespace floc
