#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace floc {

/// Returns the candidate at the least Levenshtein distance from `name` (letters inserted, removed or replaced),
/// the first of several; empty without candidates. Used in messages about unknown names.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace floc
