#pragma once

#include "floc/contact/law.h"
#include "floc/relaxation/cell_response.h"

namespace floc {

/// Masses and rate caps of the cell for scenes that give none (docs/quasistatic.md has the measurements).

/// Mass of the cell during assembly. A lighter cell makes packings from a gas looser than the published ones.
inline constexpr double kAssemblyCellMass = 1.0;
/// Mass of the cell on load paths. A heavier cell overshoots and compacts; a lighter one gives the same densities.
inline constexpr double kLoadCellMass = 0.1;
/// Cap on the strain rate of cohesive grains, in 1/T0 with T0 = sqrt(a m/F0).
inline constexpr double kStrainRateCap = 0.05;
/// Cap on the inertial number |L'/L| sqrt(m/P) of grains without adhesion.
inline constexpr double kLargestInertialNumber = 1e-3;

/// Returns the default cap on the strain rate: relative to T0 for a law with adhesion, else on the inertial number.
inline CellResponse default_cap(const Law& law) {
  CellResponse response;
  if (law.adheres())
    response.strain_rate_cap = kStrainRateCap;
  else
    response.inertial_number_cap = kLargestInertialNumber;
  return response;
}

/// Returns the response of the cell in stages of a load path if neither they nor the scene give one.
inline CellResponse default_load_response(const Law& law) {
  CellResponse response = default_cap(law);
  response.cell_mass = kLoadCellMass;
  return response;
}

}  // namespace floc
