#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace floc {

/// A list of strings, stored one after the other in a single block of memory. The list takes less memory than a vector
/// of strings, which matters for tables with millions of cells.
class PackedStrings {
 public:
  std::size_t size() const { return ends_.size(); }

  void push_back(std::string_view text) {
    characters_.append(text);
    ends_.push_back(characters_.size());
  }

  /// Returns string number k. The returned view is valid until the next push_back().
  std::string_view operator[](std::size_t k) const {
    const std::size_t begin = k == 0 ? 0 : ends_[k - 1];
    return std::string_view(characters_).substr(begin, ends_[k] - begin);
  }

 private:
  std::string characters_;         ///< characters of all strings
  std::vector<std::size_t> ends_;  ///< end of each string in `characters_`
};

}  // namespace floc
