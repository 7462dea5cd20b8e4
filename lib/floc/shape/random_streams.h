#pragma once

#include <cstdint>

namespace floc {

/// Numbers of the random streams (RandomStream) of the shape generators, one stream per generator.
inline constexpr std::uint64_t kHullStream = 4601;
inline constexpr std::uint64_t kCutStream = 4602;
inline constexpr std::uint64_t kVoronoiStream = 4603;

}  // namespace floc
