#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "floc/packing/body_name.h"

namespace floc {

inline constexpr std::size_t kMaxListed = 5;  ///< largest number of violations that a message lists

/// Grains or contacts that violate a criterion, each with the magnitude of its violation.
class Violations {
 public:
  void add(double how_bad, std::string name) { found_.emplace_back(how_bad, std::move(name)); }

  std::string worst_first() {
    std::stable_sort(found_.begin(), found_.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::string text;
    for (std::size_t k = 0; k < std::min(kMaxListed, found_.size()); ++k)
      text += fmt::format("{}{}", k == 0 ? "" : ", ", found_[k].second);
    if (found_.size() > kMaxListed) text += fmt::format(" and {} more", found_.size() - kMaxListed);
    return text;
  }

 private:
  std::vector<std::pair<double, std::string>> found_;
};

}  // namespace floc
