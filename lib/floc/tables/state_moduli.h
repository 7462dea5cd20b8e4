#pragma once

#include <optional>
#include <string>

#include "floc/tables/fit_tables.h"

namespace floc {

/// Moduli of a saved state. Its elastic line is ln Phi = ln phi + (P - pressure)/B.
struct StateModuli {
  std::string file;
  std::string unit;  ///< unit of the moduli and the pressure; empty for reduced units
  double B, B_S, pressure, phi;
  /// Moduli for a strain along one axis only: stress on this axis over the strain (M), and mean stress over the
  /// strain (B_uniaxial), both in `unit`; absent if no axis is given.
  std::optional<double> M = {}, B_uniaxial = {};
};

/// Reads a state file and computes its moduli.
/// @param axis  driven axis of an oedometer test, from 0; -1 if there is none
/// @throws InputError if the file is not a state, or has no such axis
StateModuli moduli_of(const std::string& file, int axis = -1);

/// Converts moduli to the unit of the pressures of a load path. If the path has no unit, the moduli are left
/// unchanged.
/// @throws InputError if the units cannot be converted, or the path has a unit and the state is in reduced units
StateModuli in_unit_of(const PathTable& path, StateModuli moduli);

/// Returns the driven axis of a row of a table of `floc run`, from 0; -1 if the load is not that of an
/// oedometer test.
int driven_axis(const PathTable& path, int row);

/// Computes the moduli of the state that a row of a load path names, if its file is in the directory of the
/// table.
std::optional<StateModuli> moduli_of_row(const PathTable& path, int row, int axis = -1);

}  // namespace floc
