#pragma once

#include <functional>
#include <string>
#include <vector>

#include "floc/io/state_file.h"
#include "floc/petsc/parallel_solver.h"
#include "process/output.h"

namespace floc {

/// Work on a state that may use it up.
using StateChange = std::function<void(const std::string& file, AnyState& state, const Remarks& remarks)>;

/// What for_each_state() does, on all processes of a solver: the first checks the seal of a file and reads it, then
/// each of the others reads it for itself. The first calls `check`, whose exit code decides whether all call `work`.
/// A fault is said once, and the next file is taken up; one inside `work` on some processes alone ends all of them.
/// @return the worst of the exit codes, the same on all
int for_each_state_together(const std::vector<std::string>& files, ParallelSolver& solver,
                            const StateWork& check, const StateChange& work);

}  // namespace floc
