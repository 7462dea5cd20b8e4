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
  /// Reason why no table applies, as the beginning of a sentence; empty if a table applies.
  std::string problem;
};

/// Returns the stiffness number of a scene: a K_N/F0 for cohesive grains, (E~/P)^(2/3) for elastic spheres, otherwise
/// K_N/P, with the largest diameter a, the normal stiffness K_N, the pull-off force F0, the first pressure P and E~ =
/// E/(1 - nu^2). Scenes with rigid contacts have no stiffness number.
std::optional<double> stiffness_number(const Scene& scene);

/// Returns the table of prices that applies to the kind of a scene (see scene_kind()), to its stiffness and to its
/// cell. The rows of observables that the scene does not have are left out (has_observable()).
/// @param file  file of a table that floc tradeoff has written; empty: the table shipped with floc
/// @throws InputError if there is no such file, or if the table is not valid
ScenePrices prices_of(const Scene& scene, const std::string& file);

/// Returns the mass of the cell and the cap on its strain rate in each part of a run: first in the assembly, then in
/// each stage of the load path. Each number is divided by its default value for cohesive grains. The result is empty
/// for scenes with walls and for grains without adhesion, because the tables of prices for these scenes are not
/// measured with the default cell.
std::vector<CellFactors> cells_of(const Scene& scene);

}  // namespace floc
