#include "floc/campaign/campaign_directory.h"

#include <filesystem>

#include "floc/base/error.h"
#include "floc/campaign/read_campaign.h"

namespace floc {

namespace fs = std::filesystem;

PlannedCampaign campaign_of(const std::string& directory) {
  const fs::path file = fs::path(directory) / kCampaignFile;
  if (!fs::is_regular_file(file) || !fs::is_regular_file(fs::path(directory) / kCampaignScene))
    throw InputError(directory,
                     "this directory contains no campaign: expected a directory that floc campaign plan wrote");
  PlannedCampaign planned{read_campaign(file.string(), kCampaignScene), {}};
  // A campaign without a name gets the name of its file. Here this file is always campaign.toml, so the name of the
  // directory is used instead.
  if (planned.campaign.name == file.stem().string())
    planned.campaign.name = fs::canonical(directory).filename().string();
  planned.plans = plan_cases(planned.campaign);
  return planned;
}

}  // namespace floc
