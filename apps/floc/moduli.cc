#include "command.h"

namespace floc {

Command add_moduli(CLI::App& program) {
  CLI::App* app = program.add_subcommand("moduli", "not built yet");
  return {app, [] { return int{kFailure}; }};
}

}  // namespace floc
