#pragma once

#include <string>

namespace floc {

/// Returns the commands that a user may run next on the directory of a run or of an ensemble, for its last message: one
/// per line, and only those for which its states and its path suffice.
/// @param files  shell pattern of its states, relative to the directory
std::string next_steps(const std::string& directory, const std::string& files);

}  // namespace floc
