#pragma once

#include <limits>

namespace floc {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace floc
