#pragma once

#include <map>
#include <string>
#include <vector>

namespace floc {

/// Returns the path of the file for the state number `step` of a run. The first file in the directory of the run is
/// state-0000.h5.
std::string state_file(const std::string& directory, int step);

/// Returns the paths of the state files in the directory of a run. The key of each path is the number in the name of
/// the file.
std::map<int, std::string> numbered_states(const std::string& directory);

/// Checks that the state files in a directory belong to one run: they are numbered from 0 without a gap, the number in
/// each name equals the number recorded in the file, and all states have the same seed and scene. For files above 16 MB
/// only the names are checked, because opening these files takes too long.
/// @throws InputError that names the first file that does not belong to the run
void require_one_run(const std::string& directory);

/// Checks the directories of the samples of an ensemble: each must contain one run (see require_one_run()), all must
/// have equal scenes, and their tables path.csv must be complete.
/// @throws InputError that names the file that violates one of these conditions
void require_one_ensemble(const std::vector<std::string>& directories);

}  // namespace floc
