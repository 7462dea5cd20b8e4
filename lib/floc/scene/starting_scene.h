#pragma once

#include <string>

namespace floc {

/// Returns the text of a scene with comments, from which users can start to write their own scene. It is the demo scene
/// shipped with floc, with `name` as its name.
/// @param name  name of the scene: letters, digits, '.', '_' and '-' only
/// @throws InputError if the name is empty or contains other characters
std::string starting_scene(const std::string& name);

}  // namespace floc
