#pragma once

#include "process/command.h"

namespace floc {

Command add_lattice(CommandLine program);

}  // namespace floc
