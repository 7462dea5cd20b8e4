#pragma once

#include <optional>
#include <string>

#include "floc/packing/state.h"

namespace floc {

/// Returns the first line of path.csv, which has the names of the columns.
/// @param boxed  whether the packing has walls, which the last columns describe
std::string path_header(int dimension, bool boxed);

/// Sides of the cell to which the strains in a row of path.csv refer.
template <int Dim>
struct PathReference {
  Vec<Dim> first_sides;  ///< sides in the first state of the run (length)
  /// sides in the state before this one (length); absent for the first state
  std::optional<Vec<Dim>> sides_before;
};

/// Returns the line of path.csv for one equilibrium. Except for the wall time, it follows from the states of the run
/// alone.
/// @param seconds  wall time of the step (s); absent if it was not measured
/// @param file  name of the state file in the directory of the run
template <int Dim>
std::string path_row(const State<Dim>& state, const PathReference<Dim>& reference,
                     std::optional<double> seconds, const std::string& file);

}  // namespace floc
