#pragma once

#include <functional>
#include <string>
#include <vector>

#include "floc/io/state_file.h"
#include "floc/petsc/parallel_solver.h"
#include "process/output.h"

namespace floc {

/// A function that processes a state that was read from a file. It may change the state or take over its memory.
using StateChange = std::function<void(const std::string& file, AnyState& state, const Remarks& remarks)>;

/// Processes files as for_each_state() does, but on all processes of a solver. The steps for each file are:
/// 1. The first process verifies the checksum of the file and reads it; then the other processes read it.
/// 2. The first process calls `check`.
/// 3. If the exit code of `check` is 0, all processes call `work`.
///
/// An error is printed once, and the next file is processed. However, if an error in `work` occurs on only some of the
/// processes, all processes are ended.
/// @return worst of the exit codes, the same on all processes
int for_each_state_together(const std::vector<std::string>& files, ParallelSolver& solver,
                            const StateWork& check, const StateChange& work);

}  // namespace floc
