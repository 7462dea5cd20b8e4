#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "floc/base/parse_number.h"

namespace floc {

/// Seeds of random numbers, from `first` to `last`, both included. Each seed gives one packing of an ensemble.
struct SeedRange {
  std::uint64_t first;
  std::uint64_t last;
};

/// Returns the range that a text "A..B" describes, where A and B are whole numbers with A <= B. Returns std::nullopt
/// for any other text.
inline std::optional<SeedRange> seed_range_of(std::string_view text) {
  const auto dots = text.find("..");
  if (dots == std::string_view::npos) return std::nullopt;
  const auto first = parse_number<std::uint64_t>(text.substr(0, dots));
  const auto last = parse_number<std::uint64_t>(text.substr(dots + 2));
  if (!first || !last || *first > *last) return std::nullopt;
  return SeedRange{*first, *last};
}

}  // namespace floc
