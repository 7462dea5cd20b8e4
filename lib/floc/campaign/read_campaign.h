#pragma once

#include <string>

#include "floc/campaign/campaign.h"

namespace floc {

/// Reads a campaign file (TOML; keys in docs/commands/campaign.md) and the text of its scene, found beside it.
/// @param scene  file beside it that replaces the scene that the campaign names; empty: none
/// @throws InputError naming every fault, one line each, as "file:line: key = value: expectation"
Campaign read_campaign(const std::string& path, const std::string& scene = "");

}  // namespace floc
