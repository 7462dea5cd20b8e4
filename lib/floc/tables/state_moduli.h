#pragma once

#include <optional>
#include <string>

#include "floc/tables/fit_tables.h"

namespace floc {

/// Bulk moduli of a saved state, and the elastic line through it: ln Phi = ln phi + (P - pressure)/B.
struct StateModuli {
  std::string file;
  std::string unit;  ///< unit of the moduli and the pressure; empty in reduced units
  double B, B_S, pressure, phi;
  /// For a strain of one axis alone: stress on that axis over the strain, and mean stress over the strain (stress).
  /// Absent if no axis is given.
  std::optional<double> M = {}, B_uniaxial = {};
};

/// Reads a state file and computes its moduli.
/// @param axis  driven axis of an oedometer, from 0; -1: none
/// @throws InputError if the file is no state, or has no such axis
StateModuli moduli_of(const std::string& file, int axis = -1);

/// Converts moduli to the unit of the pressures of a path. A path without a unit is taken to be in that of the state.
/// @throws InputError if the units cannot be converted, or the path has a unit and the state is in reduced units
StateModuli in_unit_of(const PathTable& path, StateModuli moduli);

/// Returns the driven axis of a row of `floc run`, from 0; -1 if the row is not loaded as in an oedometer.
int driven_axis(const PathTable& path, int row);

/// Computes the moduli of the state that a row of a path names, if its file lies beside the table.
std::optional<StateModuli> moduli_of_row(const PathTable& path, int row, int axis = -1);

}  // namespace floc
