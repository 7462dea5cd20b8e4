#pragma once

#include <string>
#include <vector>

#include "floc/campaign/campaign.h"

namespace floc {

/// A key of the scene and its values; a grid has every combination of the values of its axes.
struct GridAxis {
  std::string key;
  std::vector<std::string> values;  ///< as TOML writes them
  std::string place;                ///< file and line, for messages
};

/// Fills in the cases of a campaign and the keys in which they differ: every listed case with every combination
/// of the grid, the last axis changing first; a single case without changes where there is neither. Each gets a
/// label of its own, from its name or its values.
/// @param place  of the campaign, for messages
void set_cases(const std::vector<GridAxis>& grid, const std::vector<CampaignCase>& listed,
               const std::string& place, Campaign& campaign);

}  // namespace floc
