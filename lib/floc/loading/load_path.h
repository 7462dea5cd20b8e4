#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace floc {

/// One turn of a load path: from the present pressure to `to`, in geometric steps. A turn to the present pressure is a
/// hold: one new equilibrium, after the changes of `set`.
struct LoadTurn {
  std::string name;  ///< branch name: "load", "unload", ...
  double to = 0.0;   ///< pressure (unit of stress of the scene), >= 0
  std::optional<double>
      steps_per_decade;      ///< pressure grows by 10^(1/steps_per_decade) a step; the last may be shorter
  std::optional<int> steps;  ///< or this many equal factors
  /// Changes of the contact law made when the turn starts: path below [contact] and value, e.g. "adhesion.force" 0.
  std::vector<std::pair<std::string, double>> set;
};

/// Pressures of a turn that starts at `from`, the last exactly `turn.to`. From or to zero there is no factor: one step.
std::vector<double> turn_pressures(double from, const LoadTurn& turn);

}  // namespace floc
