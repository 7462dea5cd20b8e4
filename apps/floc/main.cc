#include <fmt/format.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <csignal>
#include <exception>
#include <iostream>
#include <optional>
#include <vector>

#include "campaign/campaign.h"
#include "commands/export.h"
#include "commands/help.h"
#include "commands/lattice_command.h"
#include "floc/base/error.h"
#include "floc/base/version.h"
#include "floc/io/transient_file.h"
#include "process/command.h"
#include "process/command_line.h"
#include "process/finish_output.h"

namespace {

using AddCommand = floc::Command (*)(floc::CommandLine);
constexpr AddCommand kCommands[] = {
    floc::add_run,    floc::add_scene,    floc::add_moduli,    floc::add_modes,   floc::add_network,
    floc::add_forces, floc::add_lattice,  floc::add_structure, floc::add_compare, floc::add_fit,
    floc::add_verify, floc::add_info,     floc::add_convert,   floc::add_chain,   floc::add_draw,
    floc::add_plot,   floc::add_report,   floc::add_tradeoff,  floc::add_plan,    floc::add_demo,
    floc::add_export, floc::add_campaign, floc::add_help};

int run_command(const std::vector<floc::Command>& commands) {
  for (const floc::Command& command : commands)
    if (command.app.parsed()) return command.run();
  return floc::kUsage;
}

int report(int code, const std::exception& error) {
  std::cerr << "floc: " << error.what() << '\n';
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  // If the reader of stdout closes the pipe, as in "| head -1", this program ends silently. It does so even if its
  // parent process ignores SIGPIPE.
  std::signal(SIGPIPE, SIG_DFL);
  floc::remove_transient_files_on_signals();
  // With SIGXFSZ ignored, writing beyond the limit of the file size (ulimit -f) gives an error message and does not
  // kill the program.
  std::signal(SIGXFSZ, SIG_IGN);
  spdlog::set_default_logger(spdlog::stderr_logger_st("floc"));
  spdlog::set_pattern("%v");

  floc::ProgramLine line("floc",
                         "Static equilibria of granular packings and the mechanics of their contact networks",
                         fmt::format("floc {} ({})", floc::version(), floc::commit()));
  floc::CommandLine program = line.top();
  program.require_one_subcommand();
  std::vector<floc::Command> commands;
  for (const AddCommand add : kCommands) commands.push_back(add(program));

  std::vector<char*> arguments = floc::arguments_of_help(argc, argv);
  try {
    const std::optional<int> parsed = line.parse(static_cast<int>(arguments.size()), arguments.data());
    const int code = parsed ? *parsed : run_command(commands);
    floc::finish_output();
    return code;
  } catch (const floc::InputError& error) {
    return report(floc::kBadInput, error);
  } catch (const std::exception& error) {
    return report(floc::kFailure, error);
  }
}
