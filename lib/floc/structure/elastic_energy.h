#pragma once

#include <optional>

#include "floc/packing/law/contact_energy.h"
#include "floc/packing/packing.h"

namespace floc {

/// Returns the elastic energy of all contacts of a packing, divided by the number of grains (energy); 0 without grains.
template <int Dim>
double elastic_energy_per_grain(const Packing<Dim>& packing);

/// Returns the largest pressure in a Hertz contact of two spheres, 3 N/(2 pi R* h) (force/length^2). This pressure acts
/// in the middle of the contact area, which is a disk of radius sqrt(R* h).
/// @param N  elastic normal force
/// @param h  overlap (length), > 0
/// @param R  reduced radius R* with 1/R* = 1/Ri + 1/Rj for spheres of radii Ri and Rj (length), > 0
double hertz_contact_pressure(double N, double h, double R);

/// Returns the largest hertz_contact_pressure() over the contacts of a packing of spheres.
/// @return no value if there are no contacts, or if a contact does not follow Hertz' law: 2 K_N h = 3 N, with stiffness
/// K_N, overlap h and force N
std::optional<double> largest_contact_pressure(const Packing<3>& packing);

}  // namespace floc
