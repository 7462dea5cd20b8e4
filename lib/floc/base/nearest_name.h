#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace floc {

/// The candidate that `name` turns into with the fewest letters inserted, removed or replaced (Levenshtein
/// distance), the first of several; empty without candidates. For messages about unknown names.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace floc
