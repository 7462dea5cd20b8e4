#pragma once

#include <string>
#include <vector>

namespace floc {

/// Returns the differences between two scenes: each key whose values differ, with both values, for example
/// "grains.count = 400 in A, = 200 in B". The result is empty if the scenes differ only in comments and layout.
/// @param first, second  texts of the two scenes (TOML)
/// @param here, there  words for the two scenes in the result, for example "in A" and "in B"
/// @throws InputError if a text is not TOML
std::vector<std::string> scene_changes(const std::string& first, const std::string& here,
                                       const std::string& second, const std::string& there);

/// Returns whether a scene continues the load path of another scene and is otherwise equal to it. The longer scene may
/// have additional stages. The last stage that both scenes have may differ in its end and in its number of steps (keys
/// to, strain, stress and steps). The function does not check whether the steps of this stage agree in both scenes.
/// @param longer, begun  texts of the two scenes (TOML)
/// @throws InputError if a text is not TOML
bool continues_path(const std::string& longer, const std::string& begun);

}  // namespace floc
