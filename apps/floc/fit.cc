#include "command.h"

namespace floc {

Command add_fit(CLI::App& program) {
  CLI::App* app = program.add_subcommand("fit", "not built yet");
  return {app, [] { return int{kFailure}; }};
}

}  // namespace floc
