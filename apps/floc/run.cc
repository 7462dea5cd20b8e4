#include "command.h"

namespace floc {

Command add_run(CLI::App& program) {
  CLI::App* app = program.add_subcommand("run", "not built yet");
  return {app, [] { return int{kFailure}; }};
}

}  // namespace floc
