#pragma once

#include "process/command.h"

namespace floc {

/// Adds `floc campaign` with its subcommands.
Command add_campaign(CommandLine program);

}  // namespace floc
