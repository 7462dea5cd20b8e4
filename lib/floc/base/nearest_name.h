#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace floc {

/// The candidate that takes the fewest letters inserted, removed or replaced to become `name` (Levenshtein
/// distance), the first of several; empty without candidates. For messages about names that are not known.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace floc
