#pragma once

#include <string>

#include "floc/campaign/campaign_directory.h"
#include "process/command.h"

namespace floc {

Command add_campaign_new(CommandLine campaign);
Command add_campaign_check(CommandLine campaign);
Command add_campaign_plan(CommandLine campaign);
Command add_campaign_run(CommandLine campaign);
Command add_campaign_collect(CommandLine campaign);
Command add_campaign_outcome(CommandLine campaign);
Command add_campaign_page(CommandLine campaign);

/// Reads a campaign file and plans its runs.
/// @throws InputError if the file has an error, or contains the name of a column that no table has, or an option that a
/// command does not accept; the message gives file and line
PlannedCampaign planned_campaign(const std::string& file);

}  // namespace floc
