#pragma once

#include "floc/contact/law.h"
#include "floc/relaxation/cell_response.h"

namespace floc {

/// Default mass of the cell and default caps on its strain rate (measurements: docs/quasistatic.md).

/// Mass of the cell during assembly, over the mass of all grains. With a lighter cell, packings made from a gas are
/// looser than the published ones.
inline constexpr double kAssemblyCellMass = 1.0;
/// Mass of the cell on load paths, over the mass of all grains. A heavier cell overshoots and compacts the packing; a
/// lighter one gives the same densities.
inline constexpr double kLoadCellMass = 0.1;
/// Cap on the strain rate of the cell for cohesive grains, in units of 1/T0 with T0 = sqrt(a m/F0).
inline constexpr double kStrainRateCap = 0.05;
/// Cap on the inertial number |L'/L| sqrt(m/P) of the cell, for grains without adhesion.
inline constexpr double kLargestInertialNumber = 1e-3;

/// Returns the default cap on the strain rate of the cell: a cap in units of 1/T0 for a law with adhesion, otherwise a
/// cap on the inertial number.
inline CellResponse default_cap(const Law& law) {
  CellResponse response;
  if (law.adheres())
    response.strain_rate_cap = kStrainRateCap;
  else
    response.inertial_number_cap = kLargestInertialNumber;
  return response;
}

/// Returns the default mass of the cell and cap on its strain rate for the stages of a load path. They apply if neither
/// the stage nor the rest of the scene gives these values.
inline CellResponse default_load_response(const Law& law) {
  CellResponse response = default_cap(law);
  response.cell_mass = kLoadCellMass;
  return response;
}

}  // namespace floc
