#pragma once

#include <optional>
#include <string>

#include "floc/tables/fit_tables.h"

namespace floc {

/// Moduli of a saved state, with its pressure and its solid fraction phi. The elastic line of the state predicts the
/// solid fraction Phi at another pressure P: ln Phi = ln phi + (P - pressure)/K, where K is B_S or, in an oedometer
/// test, B_uniaxial.
struct StateModuli {
  std::string file;
  std::string unit;  ///< unit of the moduli and of the pressure; empty for reduced units
  double B, B_S, pressure, phi;
  /// Moduli for a strain along one axis only, as in an oedometer test, in the unit `unit`. M is the increment of the
  /// stress on this axis divided by the strain; B_uniaxial is the increment of the mean stress divided by the strain.
  /// Absent if no axis is given.
  std::optional<double> M = {}, B_uniaxial = {};
};

/// Reads a state file and computes the moduli of the state.
/// @param axis  number (from 0) of the driven axis of an oedometer test; -1 if there is none
/// @throws InputError if the file is not a state file, or if the state has no such axis
StateModuli moduli_of(const std::string& file, int axis = -1);

/// Converts the moduli of a state to the unit of the pressures of a load path. If the path has no unit, the moduli are
/// not changed.
/// @throws InputError if the units cannot be converted, or if the path has a unit and the state is in reduced units
StateModuli in_unit_of(const PathTable& path, StateModuli moduli);

/// Returns the number (from 0) of the driven axis in a row of a load path from `floc run`; -1 if the row is not part of
/// an oedometer test.
int driven_axis(const PathTable& path, int row);

/// Computes the moduli of the state that is named in a row of a load path. Returns nothing if the file of this state is
/// not in the directory of the table.
/// @param axis  number (from 0) of the driven axis of an oedometer test; -1 if there is none
std::optional<StateModuli> moduli_of_row(const PathTable& path, int row, int axis = -1);

}  // namespace floc
