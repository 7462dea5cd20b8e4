#pragma once

#include <functional>
#include <string>
#include <vector>

#include "floc/io/state_file.h"
#include "floc/petsc/parallel_solver.h"
#include "process/output.h"

namespace floc {

/// A function that processes a state read from a file and may modify the state or move from it.
using StateChange = std::function<void(const std::string& file, AnyState& state, const Remarks& remarks)>;

/// Processes files as for_each_state() does, on all processes of a solver. The first process verifies the checksum of a
/// file and reads it, and then the other processes read it. The first process calls `check`; only if its exit code is
/// 0, all processes call `work`. An error is printed once, and the next file is processed; but an error in `work` that
/// occurs on only some of the processes ends all processes.
/// @return worst of the exit codes, the same on all processes
int for_each_state_together(const std::vector<std::string>& files, ParallelSolver& solver,
                            const StateWork& check, const StateChange& work);

}  // namespace floc
