#pragma once

#include <string>
#include <vector>

namespace floc {

/// Returns the file path.csv in the directory of a run.
/// @throws InputError if there is none; for the directory of an ensemble the message names one of its samples
std::string table_of_run(const std::string& directory);

/// Returns the state files in the directory of a run, from state-0000.h5 on, in order.
/// @throws InputError if there is none
std::vector<std::string> states_of_run(const std::string& directory);

/// Returns the inputs that are files, and in place of each directory the state files of that run: those of `steps`, or
/// all if `steps` is empty.
/// @throws InputError if a directory has no states, or if `steps` are given but no directory
std::vector<std::string> states_of_inputs(const std::vector<std::string>& inputs,
                                          const std::vector<int>& steps = {});

/// Returns the files that states_of_inputs() returns; if `steps` is empty, only `count` states of each directory,
/// spread evenly from the first to the last.
std::vector<std::string> drawn_states(const std::vector<std::string>& inputs, const std::vector<int>& steps,
                                      int count);

/// Returns `count` numbers of states of a run, spread evenly from the first to the last, or all numbers if there are
/// not more.
std::vector<int> spread_steps(const std::string& directory, int count);

}  // namespace floc
