#pragma once

#include <cstdint>

namespace floc {

/// Numbers of the independent random streams (RandomStream) that are derived from the seed of a run: one for the gas
/// and its random velocities, one for the vibration of a packing, and one for the assignment of shapes to grains.
inline constexpr std::uint64_t kAssemblyStream = 1;
inline constexpr std::uint64_t kVibrationStream = 2;
inline constexpr std::uint64_t kShapeStream = 3;

}  // namespace floc
