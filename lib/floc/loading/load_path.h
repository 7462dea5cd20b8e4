#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "floc/relaxation/cell_response.h"

namespace floc {

/// One stage of a load path: from the present pressure to `to`, in geometric steps. A stage to the present
/// pressure is a hold: one new equilibrium, after the changes of `set`.
struct LoadStage {
  std::string name;  ///< branch name: "load", "unload", ...
  double to = 0.0;   ///< pressure (unit of stress of the scene), >= 0
  /// Pressure grows by 10^(1/steps_per_decade) a step; the last may be shorter.
  std::optional<double> steps_per_decade;
  std::optional<int> steps;  ///< or this many equal factors
  /// Changes of the contact law made when the stage starts: path below [contact] and value, e.g.
  /// "adhesion.force" 0.
  std::vector<std::pair<std::string, double>> set;
  CellResponse cell;  ///< during the stage
};

/// Pressures of a stage that starts at `from`, the last exactly `stage.to`. From or to zero there is no factor:
/// one step.
std::vector<double> stage_pressures(double from, const LoadStage& stage);

}  // namespace floc
