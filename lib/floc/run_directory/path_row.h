#pragma once

#include <optional>
#include <string>

#include "floc/packing/state.h"

namespace floc {

/// Returns the first line of path.csv (the table with one row for each equilibrium of a run): the names of its columns.
/// @param boxed  whether the packing has walls; if so, columns that describe the walls follow the columns that all runs
/// have
/// @param rigid  whether the grains are rigid; if so, the last columns describe contact dynamics
std::string path_header(int dimension, bool boxed, bool rigid);

/// Sides of the cell in earlier states of a run: reference lengths for the strains in a row of path.csv.
template <int Dim>
struct PathReference {
  Vec<Dim> first_sides;  ///< sides of the cell (length) in the first state of the run
  /// sides of the cell (length) in the state of the previous row; absent for the first row
  std::optional<Vec<Dim>> sides_before;
};

/// Returns the row of path.csv for one equilibrium. All values in the row, except the wall time, can be recomputed from
/// the saved states.
/// @param reference  sides of the cell in the first state of the run and in the state before this one
/// @param seconds  wall time of the step (s); absent if it was not measured
/// @param file  name of the state file, without its directory
template <int Dim>
std::string path_row(const State<Dim>& state, const PathReference<Dim>& reference,
                     std::optional<double> seconds, const std::string& file);

}  // namespace floc
