#pragma once

#include "process/command.h"

namespace floc {

/// `floc help columns [TABLE]`. Help of a command is asked of the command: see arguments_of_help().
Command add_help(CommandLine program);

/// What stands for the command line where it asks for help of a command: "floc help fit elastic" is
/// "floc fit elastic --help", and "floc help" "floc --help". Others stay as they are.
std::vector<char*> arguments_of_help(int argc, char** argv);

}  // namespace floc
