#pragma once

#include <string>
#include <vector>

#include "floc/campaign/campaign_plan.h"

namespace floc {

/// Names of the campaign file and of its scene in the directory of a campaign.
inline constexpr const char* kCampaignFile = "campaign.toml";
inline constexpr const char* kCampaignScene = "scene.toml";

/// A campaign and the plan of each of its cases.
struct PlannedCampaign {
  Campaign campaign;
  std::vector<CasePlan> plans;
};

/// Reads the campaign that `floc campaign plan` wrote into a directory, and plans its runs. @throws InputError if the
/// directory has no campaign
PlannedCampaign campaign_of(const std::string& directory);

}  // namespace floc
