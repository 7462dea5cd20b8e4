#pragma once

#include "floc/contact/law.h"
#include "floc/relaxation/cell_response.h"

namespace floc {

/// Masses and rate caps of the cell for scenes that give none (docs/quasistatic.md has the measurements).

/// During assembly. A lighter cell makes packings from a gas looser than the published ones.
inline constexpr double kAssemblyCellMass = 1.0;
/// On load paths: a heavier cell overshoots and compacts, a lighter one gives the same densities.
inline constexpr double kLoadCellMass = 0.1;
/// For cohesive grains, in 1/T0, T0 = sqrt(a m/F0).
inline constexpr double kStrainRateCap = 0.05;
/// For grains without adhesion, |L'/L| sqrt(m/P).
inline constexpr double kLargestInertialNumber = 1e-3;

/// The cap on the strain rate, of the kind for which the contact law has a scale.
inline CellResponse default_cap(const Law& law) {
  CellResponse response;
  if (law.adheres())
    response.strain_rate_cap = kStrainRateCap;
  else
    response.inertial_number_cap = kLargestInertialNumber;
  return response;
}

/// Cell response in stages of a load path where neither they nor the scene give one.
inline CellResponse default_load_response(const Law& law) {
  CellResponse response = default_cap(law);
  response.cell_mass = kLoadCellMass;
  return response;
}

}  // namespace floc
