#pragma once

#include <map>
#include <string>
#include <vector>

namespace floc {

/// Returns the file of one equilibrium in the directory of a run: DIR/state-0000.h5 and so on.
std::string state_file(const std::string& directory, int step);

/// Returns the state files of a directory by their numbers.
std::map<int, std::string> numbered_states(const std::string& directory);

/// Checks that the states in the directory of a run belong together: numbers from 0 on without a gap, one seed, one
/// scene, and the steps that their names give. States above 16 MB are not opened, because that would take too long.
/// @throws InputError naming the first file that does not belong to the run of state-0000.h5
void require_one_run(const std::string& directory);

/// Checks the directories of the samples of an ensemble as require_one_run() does. The samples must share the scene,
/// each must have one seed, and their tables must be whole.
/// @throws InputError naming a file
void require_one_ensemble(const std::vector<std::string>& directories);

}  // namespace floc
