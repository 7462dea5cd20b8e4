#pragma once

#include <optional>
#include <string>

#include "floc/packing/state.h"

namespace floc {

/// Returns the first line of path.csv.
/// @param boxed  whether the grains stand between walls, which the last columns describe
std::string path_header(int dimension, bool boxed);

/// Sides of the cell that the strains of a row refer to.
template <int Dim>
struct PathReference {
  Vec<Dim> first_sides;                  ///< sides in the first state of the run (length)
  std::optional<Vec<Dim>> sides_before;  ///< sides in the state before this one (length)
};

/// Returns the line of path.csv for one equilibrium, which follows from the states of the run alone, except for the
/// wall time.
/// @param seconds  wall time of its step (s); none if it was not measured
/// @param file     name of the file of the state in the directory
template <int Dim>
std::string path_row(const State<Dim>& state, const PathReference<Dim>& reference,
                     std::optional<double> seconds, const std::string& file);

}  // namespace floc
