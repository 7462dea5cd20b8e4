#pragma once

#include <string>

namespace floc {

/// Returns the text of a scene with comments, from which a user can start a scene of their own. It is the demo scene
/// shipped with floc, under another name.
/// @param name  name of the scene: letters, digits, '.', '_' and '-' only
/// @throws InputError if the name has other characters or is empty
std::string starting_scene(const std::string& name);

}  // namespace floc
