#pragma once

#include <functional>

#include "process/command_line.h"

namespace floc {

/// Exit codes of the program.
enum ExitCode {
  kDone = 0,
  kFailure = 1,             ///< the system or the program failed, for example the disk is full
  kUsage = 2,               ///< the command line is not valid
  kNotConverged = 3,        ///< there is no result: not converged, or a quantity does not exist
  kBadInput = 4,            ///< an input file or a value is not valid
  kVerificationFailed = 5,  ///< a comparison or a check of a state failed
  kInterrupted = 130,       ///< a signal ended the run after it wrote its checkpoint
};

/// A subcommand: its command line, and the function that runs it after parsing.
struct Command {
  CommandLine app;
  std::function<int()> run;  ///< returns the exit code; may throw InputError and IoError
};

Command add_info(CommandLine program);
Command add_verify(CommandLine program);
Command add_convert(CommandLine program);
Command add_moduli(CommandLine program);
Command add_modes(CommandLine program);
Command add_network(CommandLine program);
Command add_structure(CommandLine program);
Command add_compare(CommandLine program);
Command add_forces(CommandLine program);
Command add_run(CommandLine program);
Command add_scene(CommandLine program);
Command add_fit(CommandLine program);
Command add_chain(CommandLine program);
Command add_draw(CommandLine program);
Command add_plot(CommandLine program);
Command add_report(CommandLine program);
Command add_tradeoff(CommandLine program);
Command add_plan(CommandLine program);
Command add_demo(CommandLine program);

}  // namespace floc
