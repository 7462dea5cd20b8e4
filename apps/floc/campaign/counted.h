#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <string>

namespace floc {

/// Returns a number with its noun in the singular or in the plural: "1 case", "2 cases".
/// @param noun  noun in the singular, which forms its plural with an s
inline std::string counted(std::size_t n, const char* noun) {
  return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s");
}

}  // namespace floc
