#pragma once

#include <optional>

namespace floc {

/// Criterion that ends the compaction of a packing between walls (docs/physics.md, "Boxes with walls"). Times are in
/// units of T = sqrt(m/(P a^(Dim-2))), with the mass m and the diameter a of the largest grain and the pressure P.
struct CompactionEnd {
  enum class Criterion {
    /// Three conditions are met: the void ratio has changed by less than kSettledVoidRatio during the time kSettledTime
    /// (in units of T); the pressure of the grains on every wall equals the imposed pressure (up to kSettledPressure);
    /// and the structure that carries the load has no mechanism (motion without stiffness).
    settled,
    /// The ratio of the kinetic energy of translations to the elastic energy is at most the number
    /// CompactionEnd::energy_ratio.
    energy_ratio,
  };
  Criterion criterion = Criterion::settled;
  double energy_ratio = 2e-7;  ///< ratio of kinetic to elastic energy that ends a compaction [SVI2024]
  /// Duration of the compaction (in units of T) after which the state is recorded as it is; if absent, the relaxation
  /// is given up after RelaxationOptions::max_time.
  std::optional<double> longest;
  /// Speed at which the walls of an axis move towards or away from each other (length/time). The walls move at this
  /// speed until the pressure of the grains reaches the imposed pressure. If absent, the imposed pressure acts from the
  /// beginning.
  std::optional<double> wall_speed;

  static constexpr double kSettledVoidRatio = 1e-4;
  static constexpr double kSettledTime = 3.0;
  /// The pressure of the grains on a wall counts as equal to the imposed pressure if their relative difference is below
  /// this number.
  static constexpr double kSettledPressure = 1e-3;
};

}  // namespace floc
