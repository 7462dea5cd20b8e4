#pragma once

#include <map>
#include <string>
#include <vector>

namespace floc {

/// File of one equilibrium in the directory of a run: DIR/state-0000.h5 and on.
std::string state_file(const std::string& directory, int step);

/// The state files of a directory by their number.
std::map<int, std::string> numbered_states(const std::string& directory);

/// Checks that the states in a run's directory belong together: numbers from 0 on without a gap, one seed, one
/// scene, the steps that their names say. States above 16 MB are not opened: it would take too long.
/// @throws InputError naming the first file that does not belong to the run of state-0000.h5
void require_one_run(const std::string& directory);

/// The same for the directories of an ensemble's samples, which share the scene and have one seed each; their
/// tables must also be whole.
/// @throws InputError naming a file
void require_one_ensemble(const std::vector<std::string>& directories);

}  // namespace floc
