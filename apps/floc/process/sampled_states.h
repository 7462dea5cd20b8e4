#pragma once

#include <string>
#include <vector>

namespace floc {

/// Returns the names of the state files in the directory of a run, in order. If the directory contains several samples
/// of a scene (DIR/seed-N), returns the states of all samples, one sample after the other.
/// @throws InputError if there are no state files
std::vector<std::string> states_of_directory(const std::string& directory);

}  // namespace floc
