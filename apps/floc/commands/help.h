#pragma once

#include "process/command.h"

namespace floc {

/// Adds `floc help columns [TABLE]`. The help of a command is an option of that command: see arguments_of_help().
Command add_help(CommandLine program);

/// Rewrites a command line that asks for the help of a command: "floc help fit elastic" becomes
/// "floc fit elastic --help", and "floc help" becomes "floc --help". Returns other command lines unchanged.
std::vector<char*> arguments_of_help(int argc, char** argv);

}  // namespace floc
