#pragma once

#include <string>
#include <vector>

#include "floc/campaign/campaign.h"

namespace floc {

/// A key of the scene and its values; a grid has every combination of the values of its axes.
struct GridAxis {
  std::string key;
  std::vector<std::string> values;  ///< values in the notation of TOML
  std::string place;                ///< file and line, for messages
};

/// Sets the cases of a campaign and the keys in which they differ: every listed case with every combination of the
/// grid, in which the last axis changes first. Without both there is a single case without changes. Each case gets a
/// unique label, from its name or its values.
/// @param place  place of the campaign, for messages
void set_cases(const std::vector<GridAxis>& grid, const std::vector<CampaignCase>& listed,
               const std::string& place, Campaign& campaign);

}  // namespace floc
