#pragma once

#include <string>
#include <vector>

namespace floc {

/// Returns the state files in the directory of a run, in order. For the directory of an ensemble these are the states
/// of all samples DIR/seed-N, one sample after the other.
/// @throws InputError if there are none
std::vector<std::string> states_of_directory(const std::string& directory);

}  // namespace floc
