#pragma once

#include <string>

namespace floc {

/// Returns the commands that a user may run next on the directory of a run or of an ensemble, one per line, for the
/// last message of `floc run`. A command is left out if the states or the table path.csv in the directory are not
/// sufficient for it.
/// @param files  shell pattern of the state files, relative to the directory
std::string next_steps(const std::string& directory, const std::string& files);

}  // namespace floc
