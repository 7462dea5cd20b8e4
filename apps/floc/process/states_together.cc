#include "process/states_together.h"

#include <filesystem>
#include <iostream>

#include "floc/base/error.h"
#include "floc/io/checked_state.h"
#include "floc/packing/overlaps.h"
#include "process/command.h"
#include "process/fault.h"
#include "process/repeated_warnings.h"
#include "process/sampled_states.h"

namespace floc {
namespace {

/// Calls `work` on every process of a solver. If errors occur on several processes, only the process with the lowest
/// rank among them prints its error.
/// @return exit code of this process, the same on all processes
int together(ParallelSolver& solver, const std::string& file, const std::function<int()>& work) {
  const Fault fault = fault_of(file, work);
  double first = fault.code == kDone ? 0.0 : solver.size() - solver.rank();
  solver.maximum({&first, 1});
  const bool speaks = first == solver.size() - solver.rank();
  double code = speaks ? fault.code : kDone;
  solver.maximum({&code, 1});
  if (speaks && !fault.message.empty()) std::cerr << "floc: " << fault.message << '\n';
  return static_cast<int>(code);
}

/// Returns the files that an argument names: the file itself, or the states in a directory.
std::vector<std::string> files_of(const std::string& argument) {
  if (!std::filesystem::is_directory(argument)) return {argument};
  return states_of_directory(argument);
}

void require_file(const std::string& file, const ParallelSolver& solver) {
  if (file == "-" && solver.size() > 1)
    throw InputError(file,
                     "this name means stdin, which only one process can read: expected the name of a file");
}

}  // namespace

int for_each_state_together(const std::vector<std::string>& files, ParallelSolver& solver,
                            const StateWork& check, const StateChange& work) {
  RepeatedWarnings warnings;
  const Remarks remarks = warnings.remarks();
  const bool speaks = solver.rank() == 0;
  const auto one_file = [&](const std::string& file) -> int {
    AnyState state;
    int code = together(solver, file, [&] {
      require_file(file, solver);
      if (speaks) state = read_state(file);
      return int{kDone};
    });
    if (code != kDone) return code;
    code = together(solver, file, [&] {
      if (!speaks) state = read_checked_state(file);
      if (!speaks) return int{kDone};
      const std::string warning = std::visit([](const auto& s) { return overlap_warning(s.packing); }, state);
      if (!warning.empty()) remarks.warn(file, warning, first_number(warning));
      return check(file, state, remarks);
    });
    if (code != kDone) return code;
    const Fault fault = fault_of(file, [&] { return work(file, state, remarks), int{kDone}; });
    if (fault.code == kDone) return kDone;
    // If the network has no moduli, all processes find this, and the first process reports it. Any other error may
    // occur on only some of the processes. All processes are then ended, because the processes without an error would
    // wait forever for the others.
    if (speaks || fault.code != kNotConverged) std::cerr << "floc: " << fault.message << '\n';
    if (fault.code != kNotConverged && solver.size() > 1) solver.abort(fault.code);
    return fault.code;
  };
  return for_each_file(files, [&](const std::string& argument) {
    int code = kDone;
    std::vector<std::string> named;
    code = together(solver, argument, [&] { return named = files_of(argument), int{kDone}; });
    for (const std::string& file : named) code = worse(code, one_file(file));
    return code;
  });
}

}  // namespace floc
