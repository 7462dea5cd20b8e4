#pragma once

#include <string>
#include <vector>

namespace floc {

/// Returns the name of the file path.csv in the directory of a run.
/// @throws InputError if the directory has no path.csv. If the directory contains several samples of a scene
/// (DIR/seed-N), the message names the directory of one sample
std::string table_of_run(const std::string& directory);

/// Returns the names of the state files in the directory of a run, from state-0000.h5 on, in order.
/// @throws InputError if the directory has no state files
std::vector<std::string> states_of_run(const std::string& directory);

/// Returns the inputs with each directory replaced by the state files of its run: those with the numbers `steps` or, if
/// `steps` is empty, all of them.
/// @throws InputError if a directory has no state files, or if `steps` are given but no directory
std::vector<std::string> states_of_inputs(const std::vector<std::string>& inputs,
                                          const std::vector<int>& steps = {});

/// Returns the state files that a picture or plot shows. If `steps` is given, these are the files that
/// states_of_inputs() returns. If `steps` is empty, these are the files among the inputs, and `count` states of each
/// directory, spread evenly from the first state to the last.
std::vector<std::string> drawn_states(const std::vector<std::string>& inputs, const std::vector<int>& steps,
                                      int count);

/// Returns the numbers of `count` states of a run, spread evenly from the first state to the last. For `count` = 1,
/// returns the last state; for a run with fewer states, returns all of them.
std::vector<int> spread_steps(const std::string& directory, int count);

}  // namespace floc
