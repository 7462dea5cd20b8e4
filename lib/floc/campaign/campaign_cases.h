#pragma once

#include <string>
#include <vector>

#include "floc/campaign/campaign.h"

namespace floc {

/// One axis of the grid of a campaign: a key of the scene and a list of values for this key. The grid consists of all
/// combinations of one value per axis.
struct GridAxis {
  std::string key;
  std::vector<std::string> values;  ///< values in the notation of TOML
  std::string place;                ///< "FILE:LINE" in the campaign file, for messages
};

/// Sets `campaign.cases` to the cases, and `campaign.keys` to the keys in which the cases differ. The cases are all
/// combinations of a listed case with one value per axis of the grid; the value of the last axis changes fastest.
/// Without listed cases and without a grid, there is a single case, which does not change the scene. Each case gets a
/// unique label, made of the name of the case or of the values of the keys.
/// @param place  name of the campaign file, for messages
void set_cases(const std::vector<GridAxis>& grid, const std::vector<CampaignCase>& listed,
               const std::string& place, Campaign& campaign);

}  // namespace floc
