#pragma once

#include "process/command.h"

namespace floc {

Command add_export(CommandLine program);

}  // namespace floc
