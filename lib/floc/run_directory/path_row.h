#pragma once

#include <optional>
#include <string>

#include "floc/packing/state.h"

namespace floc {

/// First line of path.csv.
/// @param boxed  the grains stand between walls, which the last columns describe
std::string path_header(int dimension, bool boxed);

/// What the strains of a row are counted from.
template <int Dim>
struct PathReference {
  Vec<Dim> first_sides;                  ///< of the first state of the run (length)
  std::optional<Vec<Dim>> sides_before;  ///< of the state before this one
};

/// The line of path.csv for one equilibrium, from the states of the run alone, except for the wall time.
/// @param seconds  wall time of its step, empty where it was not measured
/// @param file     name of the state's file in the directory
template <int Dim>
std::string path_row(const State<Dim>& state, const PathReference<Dim>& reference,
                     std::optional<double> seconds, const std::string& file);

}  // namespace floc
