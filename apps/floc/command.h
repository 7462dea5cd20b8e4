#pragma once

#include <CLI/CLI.hpp>
#include <functional>

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
  CLI::App* app;
  std::function<int()> run;  ///< returns the exit code; may throw InputError and IoError
};

Command add_info(CLI::App& program);
Command add_verify(CLI::App& program);
Command add_convert(CLI::App& program);
Command add_moduli(CLI::App& program);
Command add_modes(CLI::App& program);
Command add_network(CLI::App& program);
Command add_structure(CLI::App& program);
Command add_compare(CLI::App& program);
Command add_run(CLI::App& program);
Command add_scene(CLI::App& program);
Command add_fit(CLI::App& program);
Command add_chain(CLI::App& program);
Command add_draw(CLI::App& program);
Command add_plot(CLI::App& program);
Command add_report(CLI::App& program);
Command add_tradeoff(CLI::App& program);

}  // namespace floc
