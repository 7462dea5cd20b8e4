#pragma once

#include <optional>
#include <string>

#include "floc/packing/state.h"

namespace floc {

/// First line of path.csv.
std::string path_header();

/// The line of path.csv for one equilibrium, from its state alone but for the wall time.
/// @param seconds  wall time of its step, empty where it was not measured
/// @param file     name of the state's file in the directory
std::string path_row(const State<2>& state, std::optional<double> seconds, const std::string& file);

}  // namespace floc
