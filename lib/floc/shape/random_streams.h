#pragma once

#include <cstdint>

namespace floc {

/// Purposes of the random streams of this module: see RandomStream.
inline constexpr std::uint64_t kHullStream = 4601;
inline constexpr std::uint64_t kCutStream = 4602;
inline constexpr std::uint64_t kVoronoiStream = 4603;

}  // namespace floc
