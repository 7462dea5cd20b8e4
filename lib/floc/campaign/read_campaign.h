#pragma once

#include <string>

#include "floc/campaign/campaign.h"

namespace floc {

/// Reads a campaign file (TOML; docs/commands/campaign.md describes its keys) and the text of its scene file.
/// @param scene  name of a scene file, relative to the campaign file, which replaces the scene file named in the
/// campaign; empty: no replacement
/// @throws InputError naming all errors, in lines such as "file:line: key = value: expectation"
Campaign read_campaign(const std::string& path, const std::string& scene = "");

}  // namespace floc
