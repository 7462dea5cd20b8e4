#pragma once

#include "process/command.h"

namespace floc {

/// Adds the command `floc export`.
Command add_export(CommandLine program);

}  // namespace floc
