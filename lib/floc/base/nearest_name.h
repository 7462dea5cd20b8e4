#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace floc {

/// Returns the candidate that is most similar to `name`, for messages about unknown names. This is the first candidate
/// with the smallest Levenshtein distance from `name` (number of insertions, removals and replacements of letters that
/// turn one name into the other). Returns an empty text if there are no candidates.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace floc
