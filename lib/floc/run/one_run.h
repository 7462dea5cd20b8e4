#pragma once

#include <map>
#include <string>
#include <vector>

namespace floc {

/// File of one equilibrium in the directory of a run: DIR/state-0000.h5 and on.
std::string state_file(const std::string& directory, int step);

/// The state files of a directory by their number.
std::map<int, std::string> numbered_states(const std::string& directory);

/// Holds the states of a run's directory together: numbers from 0 on without a gap, one seed, one scene, the step
/// that the name says. States of more than 16 MB are not opened, which would take longer than what is asked of them.
/// @throws InputError naming the first file that does not belong to the run of state-0000.h5
void require_one_run(const std::string& directory);

/// The same of the directories of an ensemble's samples, which share the scene and have a seed each; and their tables
/// are whole.
/// @throws InputError naming a file
void require_one_ensemble(const std::vector<std::string>& directories);

}  // namespace floc
