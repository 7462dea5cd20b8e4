#pragma once

#include <string>
#include <vector>

namespace floc {

/// The path.csv of a run's directory.
/// @throws InputError if it has none; for an ensemble, naming one of its samples
std::string table_of_run(const std::string& directory);

/// Files of the equilibria that a directory of floc run holds, state-0000.h5 and on, in their order.
/// @throws InputError if there is none
std::vector<std::string> states_of_run(const std::string& directory);

/// The files among the inputs, and in the place of each directory the states of that run: those of `steps`, or
/// all if it is empty.
/// @throws InputError for a directory without states, or steps without a directory
std::vector<std::string> states_of_inputs(const std::vector<std::string>& inputs,
                                          const std::vector<int>& steps = {});

/// The same, but without steps only `count` states of a directory: spread evenly from the first to the last.
std::vector<std::string> drawn_states(const std::vector<std::string>& inputs, const std::vector<int>& steps,
                                      int count);

/// `count` of the numbers of a run's states, spread evenly from the first to the last; all of them if there are
/// no more.
std::vector<int> spread_steps(const std::string& directory, int count);

}  // namespace floc
