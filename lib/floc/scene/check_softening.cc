#include "floc/scene/check_softening.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "floc/scene/scene_softening.h"

namespace floc {
namespace {

using Need = TableReader::Need;

/// Records a fault if the softening s, which a table of the scene gives, is above its limit.
/// @param limit  limit of the softening in the steps of the run to which the table applies
void check_limit(TableReader& table, double s, const SofteningLimit& limit) {
  const std::string fault = limit.fault(s);
  if (!fault.empty())
    table.fault("softening", fmt::format("{} = {}: {}", table.path_of("softening"), s, fault));
}

}  // namespace

void check_softening(TableReader& root, const SceneSource& source, const Scene& scene) {
  TableReader equilibrium = root.table("equilibrium", "", Need::optional);
  if (scene.assembly.box)
    return equilibrium.refuse("softening",
                              "equilibrium.softening is not allowed here: springs can be softened only in a "
                              "periodic cell, but the scene has walls");
  if (source.n_faults() > 0 || !(scene.grains.largest() > 0)) return;
  // For each table that can give a softening: the smallest limit of the softening among the steps to which the table
  // applies. The key is -2 for the table [equilibrium], -1 for [assembly], and otherwise the index of the table
  // [[load]].
  std::map<int, SofteningLimit> limits;
  double before = 0.0;
  for (const PlannedEquilibrium& step : plan_run(scene.assembly, scene.law, scene.load, scene.dimension)) {
    const double stress = largest_stress(step);
    const SofteningLimit limit =
        root.has("accuracy") ? SofteningLimit{1.0, "[accuracy] chooses among settings without soft springs"}
                             : softening_limit_of(step, scene, std::max(before, stress));
    before = stress;
    SofteningLimit& tightest = limits.try_emplace(step.cell.softening ? step.stage : -2, limit).first->second;
    if (limit.largest < tightest.largest) tightest = limit;
  }
  TableReader assembly = root.table("assembly", "", Need::optional);
  std::vector<TableReader> stages;
  if (root.has("load")) stages = root.tables("load", "tables [[load]]");
  for (const auto& [stage, limit] : limits) {
    if (stage == -2)
      check_limit(equilibrium, scene.relaxation.softening, limit);
    else if (stage == -1)
      check_limit(assembly, *scene.assembly.cell.softening, limit);
    else
      check_limit(stages[static_cast<std::size_t>(stage)],
                  *scene.load[static_cast<std::size_t>(stage)].cell.softening, limit);
  }
}

}  // namespace floc
