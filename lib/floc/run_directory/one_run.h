#pragma once

#include <map>
#include <string>
#include <vector>

namespace floc {

/// Returns the name of the state file of one equilibrium in the directory of a run: DIR/state-0000.h5 for step 0, and
/// so on.
std::string state_file(const std::string& directory, int step);

/// Returns the state files of a directory, by their numbers.
std::map<int, std::string> numbered_states(const std::string& directory);

/// Checks that the states in the directory of a run belong together: they are numbered from 0 without a gap, have one
/// seed and one scene, and the step recorded in each file is the number in its name. Files above 16 MB are not opened,
/// because that would take too long.
/// @throws InputError that names the first file that does not belong to the run of state-0000.h5
void require_one_run(const std::string& directory);

/// Checks the directories of the samples of an ensemble: each must satisfy require_one_run(), all must have the same
/// scene, and their files path.csv must be complete.
/// @throws InputError that names a file that does not satisfy this
void require_one_ensemble(const std::vector<std::string>& directories);

}  // namespace floc
