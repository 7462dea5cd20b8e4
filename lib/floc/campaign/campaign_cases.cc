#include "floc/campaign/campaign_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <set>

namespace floc {
namespace {

/// Label of a case that does not change the scene.
constexpr const char* kNoChange = "base";

/// Makes a text usable as part of the name of a directory: all characters except letters, digits and "+-._" become
/// hyphens.
std::string as_name(const std::string& text) {
  std::string name;
  for (const char c : text) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || std::strchr("+-._", c) != nullptr;
    if (plain)
      name += c;
    else if (!name.empty() && name.back() != '-')
      name += '-';
  }
  name.erase(0, name.find_first_not_of('.'));
  name.erase(name.find_last_not_of('-') + 1);
  return name;
}

/// Returns the shortest end of a key that distinguishes this key from all other keys of the campaign, such as
/// `coefficient` for `contact.friction.coefficient`. An end consists of one or more components of the key.
std::string short_key(const std::string& key, const std::vector<std::string>& keys) {
  for (std::size_t dot = key.rfind('.'); dot != std::string::npos && dot > 0; dot = key.rfind('.', dot - 1)) {
    const std::string end = key.substr(dot);
    if (std::count_if(keys.begin(), keys.end(),
                      [&](const std::string& k) { return ("." + k).ends_with(end); }) == 1)
      return end.substr(1);
  }
  return key;
}

std::string label_of(const CampaignCase& one, const std::vector<std::string>& keys) {
  if (!as_name(one.label).empty()) return as_name(one.label);
  std::string label;
  for (const SceneChange& change : one.changes)
    label += fmt::format("{}{}={}", label.empty() ? "" : "_", as_name(short_key(change.key, keys)),
                         as_name(change.value));
  return label.empty() ? kNoChange : label;
}

}  // namespace

void set_cases(const std::vector<GridAxis>& grid, const std::vector<CampaignCase>& listed,
               const std::string& place, Campaign& campaign) {
  std::vector<CampaignCase> cases = listed;
  if (cases.empty()) cases.push_back({"", {}, grid.empty() ? place : grid.front().place});
  for (const CampaignCase& one : cases)
    for (const SceneChange& change : one.changes)
      if (std::count(campaign.keys.begin(), campaign.keys.end(), change.key) == 0)
        campaign.keys.push_back(change.key);
  for (const GridAxis& axis : grid)
    if (std::count(campaign.keys.begin(), campaign.keys.end(), axis.key) == 0)
      campaign.keys.push_back(axis.key);

  for (CampaignCase& one : cases) one.label = label_of(one, campaign.keys);
  for (const GridAxis& axis : grid) {
    std::vector<CampaignCase> more;
    for (const CampaignCase& one : cases)
      for (const std::string& value : axis.values) {
        CampaignCase& next = more.emplace_back(one);
        next.changes.push_back({axis.key, value, axis.place});
        const std::string part = as_name(short_key(axis.key, campaign.keys)) + "=" + as_name(value);
        next.label = one.label == kNoChange ? part : one.label + "_" + part;
      }
    cases = std::move(more);
  }
  std::set<std::string> taken;
  for (CampaignCase& one : cases) {
    const std::string label = one.label;
    for (int k = 2; !taken.insert(one.label).second; ++k) one.label = fmt::format("{}-{}", label, k);
  }
  campaign.cases = std::move(cases);
}

}  // namespace floc
