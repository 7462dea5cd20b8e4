#pragma once

#include "process/command.h"

namespace floc {

/// Adds the command `floc help columns [TABLE]`. The help text of a command is printed by its option --help, to which
/// arguments_of_help() translates `floc help COMMAND`.
Command add_help(CommandLine program);

/// Rewrites a command line such as "floc help fit elastic" as "floc fit elastic --help", and "floc help" as "floc
/// --help". Returns other command lines, including those of `floc help columns`, unchanged.
std::vector<char*> arguments_of_help(int argc, char** argv);

}  // namespace floc
