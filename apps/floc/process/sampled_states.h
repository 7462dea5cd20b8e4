#pragma once

#include <string>
#include <vector>

namespace floc {

/// States of a directory of floc run in their order; of an ensemble those of all its samples DIR/seed-N, one after
/// the other.
/// @throws InputError if there is none
std::vector<std::string> states_of_directory(const std::string& directory);

}  // namespace floc
