#pragma once

#include <string>
#include <vector>

namespace floc {

/// Returns the keys in which two scenes differ, each with both values, for example "grains.count = 400 in A, = 200 in
/// B". The result is empty if the scenes differ only in comments and layout.
/// @param first, second  texts of the scenes (TOML)
/// @param here, there  names of the scenes in the result, for example "in A" and "in B"
/// @throws InputError if a text is not TOML
std::vector<std::string> scene_changes(const std::string& first, const std::string& here,
                                       const std::string& second, const std::string& there);

}  // namespace floc
