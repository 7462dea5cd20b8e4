#include "command.h"

namespace floc {

Command add_verify(CLI::App& program) {
  CLI::App* app = program.add_subcommand("verify", "not built yet");
  return {app, [] { return int{kFailure}; }};
}

}  // namespace floc
