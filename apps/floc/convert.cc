#include "command.h"

namespace floc {

Command add_convert(CLI::App& program) {
  CLI::App* app = program.add_subcommand("convert", "not built yet");
  return {app, [] { return int{kFailure}; }};
}

}  // namespace floc
