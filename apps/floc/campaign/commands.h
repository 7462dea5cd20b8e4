#pragma once

#include <string>
#include <vector>

#include "floc/campaign/campaign_plan.h"
#include "process/command.h"

namespace floc {

Command add_campaign_new(CommandLine campaign);
Command add_campaign_check(CommandLine campaign);
Command add_campaign_plan(CommandLine campaign);
Command add_campaign_run(CommandLine campaign);
Command add_campaign_collect(CommandLine campaign);
Command add_campaign_outcome(CommandLine campaign);
Command add_campaign_page(CommandLine campaign);

/// A campaign and the plan of each of its cases.
struct PlannedCampaign {
  Campaign campaign;
  std::vector<CasePlan> plans;
};

/// Reads a campaign file and plans its runs.
/// @throws InputError naming file and line if the file has an error, or names a column that no table has
PlannedCampaign planned_campaign(const std::string& file);

/// Reads the campaign that `floc campaign plan` wrote into a directory, and plans its runs. @throws InputError if the
/// directory has no campaign
PlannedCampaign campaign_of(const std::string& directory);

}  // namespace floc
