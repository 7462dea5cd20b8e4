#pragma once

#include <string>
#include <vector>

#include "floc/campaign/campaign.h"

namespace floc {

/// A key of the scene and a list of values for it. A grid is a list of such axes, and has every combination of their
/// values.
struct GridAxis {
  std::string key;
  std::vector<std::string> values;  ///< values in the notation of TOML
  std::string place;                ///< file and line of the campaign file, for messages
};

/// Sets the cases of a campaign, and the keys in which they differ. The cases are all combinations of a listed case
/// with values of the grid; the last axis of the grid changes first. If there are neither listed cases nor a grid,
/// there is a single case without changes. Each case gets a unique label, made of its name or of its values.
/// @param place  file of the campaign, for messages
void set_cases(const std::vector<GridAxis>& grid, const std::vector<CampaignCase>& listed,
               const std::string& place, Campaign& campaign);

}  // namespace floc
