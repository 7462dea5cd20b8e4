#pragma once

#include "process/command.h"

namespace floc {

Command add_campaign(CommandLine program);

}  // namespace floc
