#include "command.h"

namespace floc {

Command add_info(CLI::App& program) {
  CLI::App* app = program.add_subcommand("info", "not built yet");
  return {app, [] { return int{kFailure}; }};
}

}  // namespace floc
