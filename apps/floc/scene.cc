#include "command.h"

namespace floc {

Command add_scene(CLI::App& program) {
  CLI::App* app = program.add_subcommand("scene", "not built yet");
  return {app, [] { return int{kFailure}; }};
}

}  // namespace floc
