#pragma once

#include <string>

namespace floc {

/// Returns the text of a campaign file, with comments, as a starting point for users.
/// @param name  name of the campaign: letters, digits, '.', '_' and '-' only
/// @param scene  name of the scene file, relative to the campaign file
std::string starting_campaign(const std::string& name, const std::string& scene);

}  // namespace floc
