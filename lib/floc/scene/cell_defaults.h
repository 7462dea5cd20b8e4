#pragma once

#include "floc/loading/run_options.h"
#include "floc/relaxation/cell_response.h"

namespace floc {

/// Default mass of the cell and default caps on its strain rate (measurements: docs/quasistatic.md).

/// Default mass of the cell during the assembly, divided by the mass of all grains. With a lighter cell, packings made
/// from a gas are looser than the published packings.
inline constexpr double kAssemblyCellMass = 1.0;
/// Default mass of the cell on load paths, divided by the mass of all grains. A heavier cell overshoots the imposed
/// stress and compacts the packing; a lighter cell gives the same densities as a cell of this mass.
inline constexpr double kLoadCellMass = 0.1;
/// Default cap on the strain rate of the cell for cohesive grains, in units of 1/T0. T0 = sqrt(a m/F0), with the
/// largest diameter a, the mass m of the largest grain and the pull-off force F0.
inline constexpr double kStrainRateCap = 0.05;
/// Default cap on the inertial number |L'/L| sqrt(m/P) of the cell, for grains without adhesion. L is a side of the
/// cell, L' the rate of change of L, m the mass of the largest grain and P the pressure.
inline constexpr double kLargestInertialNumber = 1e-3;

/// Default cap on the inertial number of the cell for grains that contact dynamics moves, with or without adhesion. This
/// cap is larger than the cap for other grains, because the number of time steps for a given strain is inversely
/// proportional to the inertial number.
inline constexpr double kInertialNumberOfContactDynamics = 0.02;

/// Returns the default cap on the rate at which the cell deforms: kInertialNumberOfContactDynamics for contact
/// dynamics, else kStrainRateCap if the grains adhere, otherwise kLargestInertialNumber.
inline CellResponse default_cap(const RunOptions& run) {
  CellResponse response;
  if (run.has_contact_dynamics())
    response.inertial_number_cap = kInertialNumberOfContactDynamics;
  else if (run.law.adheres())
    response.strain_rate_cap = kStrainRateCap;
  else
    response.inertial_number_cap = kLargestInertialNumber;
  return response;
}

/// Returns the default mass of the cell and the default cap on its strain rate on the load path. A default value
/// applies to a stage if neither the stage itself nor the table [cell] of the scene gives the value.
inline CellResponse default_load_response(const RunOptions& run) {
  CellResponse response = default_cap(run);
  response.cell_mass = kLoadCellMass;
  return response;
}

}  // namespace floc
