#pragma once

#include <string>

namespace floc {

/// Returns the text of a scene with comments, from which users can start to write their own scene. The text is that of
/// the demo scene shipped with floc, with `name` as the name of the scene.
/// @param name  name of the scene: letters, digits, '.', '_' and '-' only
/// @throws InputError if the name is empty or contains other characters
std::string starting_scene(const std::string& name);

}  // namespace floc
