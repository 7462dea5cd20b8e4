#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "floc/base/parse_number.h"

namespace floc {

/// Returns the parts of a text between separators, each without blanks at its ends. A text without a separator has one
/// part.
inline std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.emplace_back(trimmed(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return parts;
}

}  // namespace floc
