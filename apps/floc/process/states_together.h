#pragma once

#include <functional>
#include <string>
#include <vector>

#include "floc/io/state_file.h"
#include "floc/petsc/parallel_solver.h"
#include "process/output.h"

namespace floc {

/// A function that processes a state and may modify or consume it.
using StateChange = std::function<void(const std::string& file, AnyState& state, const Remarks& remarks)>;

/// Processes files as for_each_state() does, on all processes of a solver. The first process checks the seal of a file
/// and reads it, then each of the others reads it. The first process calls `check`, whose exit code decides whether all
/// processes call `work`. An error is reported once, and the next file follows; an error inside `work` on only some of
/// the processes ends all of them.
/// @return worst of the exit codes; equal on all processes
int for_each_state_together(const std::vector<std::string>& files, ParallelSolver& solver,
                            const StateWork& check, const StateChange& work);

}  // namespace floc
