#pragma once

#include <optional>
#include <string>

#include "floc/packing/state.h"

namespace floc {

/// First line of path.csv; in 3D its last column is L3.
std::string path_header(int dimension);

/// The line of path.csv for one equilibrium, from its state alone but for the wall time.
/// @param seconds  wall time of its step, empty where it was not measured
/// @param file     name of the state's file in the directory
template <int Dim>
std::string path_row(const State<Dim>& state, std::optional<double> seconds, const std::string& file);

}  // namespace floc
