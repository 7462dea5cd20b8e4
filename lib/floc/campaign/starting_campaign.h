#pragma once

#include <string>

namespace floc {

/// Returns the text of a commented campaign to start from.
/// @param name   name of the campaign: letters, digits, '.', '_' and '-' only
/// @param scene  file of its scene, relative to that of the campaign
std::string starting_campaign(const std::string& name, const std::string& scene);

}  // namespace floc
