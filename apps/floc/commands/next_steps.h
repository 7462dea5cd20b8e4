#pragma once

#include <string>

namespace floc {

/// Commands that go on from what is in the directory of a run or of an ensemble, for its last message: one a line,
/// and only those that its states and its path are enough for.
/// @param files  what stands for its states in a shell, below the directory
std::string next_steps(const std::string& directory, const std::string& files);

}  // namespace floc
