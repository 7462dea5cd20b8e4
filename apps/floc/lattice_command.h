#pragma once

#include "command.h"

namespace floc {

Command add_lattice(CommandLine program);

}  // namespace floc
