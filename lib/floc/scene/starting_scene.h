#pragma once

#include <string>

namespace floc {

/// Returns the text of a commented scene to start from: the shipped demo under another name.
/// @param name  letters, digits, '.', '_' and '-' only
/// @throws InputError for another name
std::string starting_scene(const std::string& name);

}  // namespace floc
