#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/prices/accuracy.h"
#include "floc/scene/scene.h"

namespace floc {

/// Table of prices that applies to a scene, or the reason why there is none.
struct ScenePrices {
  std::optional<PriceTable> table;
  /// Reason why no table applies, in words that begin with a property of the scene; empty if one does.
  std::string problem;
};

/// Returns the table of prices for a scene: for its kind (see scene_kind()), its stiffness and its cells.
/// @param file  file of a table that floc tradeoff has written; empty: the table shipped with floc
/// @throws InputError if there is no such file, or if the table is not valid
ScenePrices prices_of(const Scene& scene, const std::string& file);

/// Returns the mass of the cell, and the cap on its strain rate, in each part of a run, first in the assembly and then
/// in each stage of the load path, divided by the default values for cohesive grains. The result is empty for grains
/// without adhesion, whose tables are not measured with the default cell, and for boxes.
std::vector<CellFactors> cells_of(const Scene& scene);

}  // namespace floc
