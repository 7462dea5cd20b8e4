#pragma once

#include "process/command.h"

namespace floc {

/// Adds the command `floc help columns [TABLE]`. `floc help COMMAND` is not part of this command: arguments_of_help()
/// turns it into `floc COMMAND --help`.
Command add_help(CommandLine program);

/// Returns the command line "floc help fit elastic" as "floc fit elastic --help", and "floc help" as "floc --help". Any
/// other command line, including that of `floc help columns`, is returned unchanged.
std::vector<char*> arguments_of_help(int argc, char** argv);

}  // namespace floc
