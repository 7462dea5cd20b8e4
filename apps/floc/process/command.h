#pragma once

#include <functional>

#include "process/command_line.h"

namespace floc {

/// Exit codes of the program.
enum ExitCode {
  kDone = 0,
  kFailure = 1,  ///< failure inside: disk full, not writable
  kUsage = 2,    ///< bad usage of the command line
  kNotConverged = 3,
  kBadInput = 4,
  kVerificationFailed = 5,
  kInterrupted = 130,  ///< a checkpoint was written
};

/// A subcommand: its command line, and what it does once that is parsed.
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
Command add_run(CommandLine program);
Command add_scene(CommandLine program);
Command add_fit(CommandLine program);
Command add_chain(CommandLine program);
Command add_draw(CommandLine program);
Command add_plot(CommandLine program);
Command add_report(CommandLine program);
Command add_tradeoff(CommandLine program);
Command add_demo(CommandLine program);

}  // namespace floc
