#pragma once

#include <optional>

namespace floc {

/// Criterion that ends the dynamic compaction of a box (docs/physics.md, "Boxes with walls"). Times are in T =
/// sqrt(m/(P a^(Dim-2))), m and a of the largest grain.
struct CompactionEnd {
  enum class Criterion {
    /// The void ratio has changed by less than kSettledVoidRatio in kSettledTime, every wall bears its
    /// pressure, and the structure that carries it has no mechanism.
    settled,
    energy_ratio,  ///< kinetic energy of translations over elastic energy is at most `energy_ratio`
  };
  Criterion criterion = Criterion::settled;
  double energy_ratio = 2e-7;  ///< [SVI2024]
  /// Longest compaction (T), after which the state is recorded as it is; absent: the relaxation is given up at
  /// its max_time.
  std::optional<double> longest;
  /// Speed at which walls move towards or away from each other until they bear their pressure (length/time);
  /// absent: the pressure acts from the beginning.
  std::optional<double> wall_speed;

  static constexpr double kSettledVoidRatio = 1e-4;
  static constexpr double kSettledTime = 3.0;
  /// Relative difference from the imposed pressure up to which a wall counts as bearing it.
  static constexpr double kSettledPressure = 1e-3;
};

}  // namespace floc
