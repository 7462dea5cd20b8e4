#pragma once

#include <string>

namespace floc {

/// Returns commands that a user may run next on the directory of a run or of an ensemble, one command per line, for the
/// last message of `floc run`. A command is left out if it would fail on the states or on the tables path.csv in the
/// directory.
/// @param files  shell pattern of the state files, relative to the directory
std::string next_steps(const std::string& directory, const std::string& files);

}  // namespace floc
