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
  /// Of one axis, where one is asked for: the modulus of its strain alone, and how the mean stress answers it, over
  /// that strain (stress).
  std::optional<double> M = {}, B_uniaxial = {};
};

/// @param axis  driven axis of an oedometer, from 0; -1: none
/// @throws InputError if the file is no state, or has no such axis
StateModuli moduli_of(const std::string& file, int axis = -1);

/// Moduli converted to the unit of a path's pressures; a path that names none has that of the state.
/// @throws InputError if the units cannot be converted, or the path has one and the state is in reduced units
StateModuli in_unit_of(const PathTable& path, StateModuli moduli);

/// The driven axis of a row of `floc run`, from 0; -1 where it is not loaded as in an oedometer.
int driven_axis(const PathTable& path, int row);

/// Of the state that a row of a path names, if it lies beside the table.
std::optional<StateModuli> moduli_of_row(const PathTable& path, int row, int axis = -1);

}  // namespace floc
