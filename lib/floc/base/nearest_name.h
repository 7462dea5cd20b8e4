#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace floc {

/// Returns the candidate that is most similar to `name`, for messages about unknown names. The most similar name has
/// the smallest Levenshtein distance: the smallest number of letters to insert, remove or replace that turns one name
/// into the other. Returns the first of several equally similar candidates, and an empty text if there are no
/// candidates.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace floc
