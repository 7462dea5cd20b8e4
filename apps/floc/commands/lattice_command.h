#pragma once

#include "process/command.h"

namespace floc {

/// Adds the command `floc lattice`.
Command add_lattice(CommandLine program);

}  // namespace floc
