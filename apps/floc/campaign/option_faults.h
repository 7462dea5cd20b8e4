#pragma once

#include <string>
#include <vector>

#include "floc/campaign/campaign.h"

namespace floc {

/// Returns a message for each [[collect]] and each [[fit]] of a campaign whose options its command does not accept. The
/// message gives file and line.
///
/// Each command is started in a child process with its options and with the name of a file that cannot exist. The
/// command line of the command itself thus judges the options, before any run begins.
/// @throws IoError if no directory for temporary files can be made, or no process can be started
std::vector<std::string> option_faults(const Campaign& campaign);

}  // namespace floc
