#include "floc/scene/check_time_steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "floc/loading/run_plan.h"

namespace floc {
namespace {

using Need = TableReader::Need;

/// Returns the reason why a part of a run cannot have this time step; empty if it can. Contacts without moments
/// leave the grains without spins, and spins are what long steps make unstable.
/// @param law  contact law in this part of the run
std::string fault_of_step(double time_step, const Law& law, bool is_assembly) {
  const bool has_moments = law.resists_sliding() || law.has_rolling() || law.has_twisting();
  if (time_step < kStableStep || !has_moments) return "";
  return fmt::format(
      "expected a number below {:g}, because grains with friction, or with resistance to rolling or twisting, "
      "are unstable with larger time steps; below {:g} without them{}",
      kStableStep, kStableStepWithoutFriction, is_assembly ? " (assembly.friction = 0)" : "");
}

}  // namespace

void check_time_steps(TableReader& root, const SceneSource& source, const Scene& scene) {
  TableReader assembly = root.table("assembly", "", Need::optional);
  std::vector<TableReader> tables;
  if (!scene.load.empty()) tables = root.tables("load", "tables [[load]]");
  tables.insert(tables.begin(), assembly);
  if (root.has("accuracy") || scene.has_contact_dynamics()) {
    for (TableReader& t : tables)
      t.refuse("time_step",
               fmt::format("{} is not allowed here: {}", t.path_of("time_step"),
                           root.has("accuracy")
                               ? "the time step is chosen by [accuracy]"
                               : "the time step of contact dynamics is given by dynamics.time_step"));
    return;
  }
  if (source.n_faults() > 0) return;
  int checked = -2;
  for (const PlannedEquilibrium& step : plan_run(scene.assembly, scene.law, scene.load, scene.dimension)) {
    if (step.stage == checked || !step.cell.time_step) continue;
    checked = step.stage;
    TableReader& t = tables[static_cast<std::size_t>(step.stage + 1)];
    if (const std::string fault = fault_of_step(*step.cell.time_step, step.law, step.stage < 0); !fault.empty())
      t.fault("time_step", fmt::format("{} = {}: {}", t.path_of("time_step"), *step.cell.time_step, fault));
  }
}

}  // namespace floc
