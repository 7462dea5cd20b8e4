#pragma once

#include <optional>
#include <string>

#include "fit_tables.h"

namespace floc {

/// Bulk moduli of a saved state, and the elastic line through it: ln Phi = ln phi + (P - pressure)/B.
struct StateModuli {
  std::string file;
  double B, B_S, pressure, phi;
};

/// @throws InputError if the file is no state
StateModuli moduli_of(const std::string& file);

/// Of the state that a row of a path names, if it lies beside the table.
std::optional<StateModuli> moduli_of_row(const PathTable& path, int row);

}  // namespace floc
