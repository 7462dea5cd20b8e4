#include "floc/scene/scene_softening.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace floc {
namespace {

bool imposes_strain(const PlannedEquilibrium& step) {
  return step.shears() || std::any_of(step.axes.begin(), step.axes.end(),
                                      [](const AxisStep& axis) { return axis.load.kind == AxisLoad::strain; });
}

std::vector<PlannedEquilibrium> steps_of(const RunOptions& run) {
  return plan_run(run.assembly, run.law, run.load, run.dimension);
}

}  // namespace

double largest_stress(const PlannedEquilibrium& step) {
  if (step.is_isotropic()) return step.pressure;
  double largest = 0.0;
  for (const AxisStep& axis : step.axes)
    if (axis.load.kind == AxisLoad::stress) largest = std::max(largest, axis.load.end);
  return largest;
}

SofteningLimit softening_limit_of(const PlannedEquilibrium& step, const RunOptions& run, double pressure) {
  if (imposes_strain(step))
    return {1.0,
            fmt::format("springs can be softened only where a stress is imposed on every axis, but the stage "
                        "\"{}\" imposes a strain",
                        step.branch)};
  return softening_limit(step.law, run.dimension, run.grains.largest(), pressure);
}

std::vector<bool> strained_stages(const RunOptions& run) {
  std::vector<bool> strained(run.load.size(), false);
  for (const PlannedEquilibrium& step : steps_of(run))
    if (step.stage >= 0 && imposes_strain(step)) strained[static_cast<std::size_t>(step.stage)] = true;
  return strained;
}

Softening softening_of(const RunOptions& run) {
  Softening softening;
  softening.assembly = run.assembly.cell.applied_to(run.relaxation).softening;
  if (run.load.empty()) softening.load = softening.assembly;
  for (const LoadStage& stage : run.load)
    softening.load = std::max(softening.load, stage.cell.applied_to(run.relaxation).softening);
  return softening;
}

Softening largest_softening(const RunOptions& run) {
  if (run.assembly.box || run.has_contact_dynamics()) return {};
  constexpr double kNoLimit = std::numeric_limits<double>::infinity();
  Softening largest{kNoLimit, kNoLimit};
  double before = 0.0;
  const std::vector<bool> strained = strained_stages(run);
  for (const PlannedEquilibrium& step : steps_of(run)) {
    const double stress = largest_stress(step);
    double& limit = step.stage < 0 ? largest.assembly : largest.load;
    if (step.stage < 0 || !strained[static_cast<std::size_t>(step.stage)])
      limit = std::min(limit, softening_limit_of(step, run, std::max(before, stress)).largest);
    before = stress;
  }
  // If springs cannot be softened in any stage, the factor of the load path is 1. If the run has no stages, this factor
  // equals the factor of the assembly.
  if (largest.load == kNoLimit) largest.load = run.load.empty() ? largest.assembly : 1.0;
  return {std::max(1.0, largest.assembly), std::max(1.0, largest.load)};
}

void give_softening(const Softening& softening, RunOptions& run) {
  run.relaxation.softening = softening.load;
  run.assembly.cell.softening = softening.assembly;
  const std::vector<bool> strained = strained_stages(run);
  for (std::size_t k = 0; k < run.load.size(); ++k)
    run.load[k].cell.softening = strained[k] ? 1.0 : softening.load;
}

NumericalSettings settings_of(const RunOptions& run) {
  NumericalSettings settings = NumericalSettings::of(run.relaxation);
  settings.softening = softening_of(run);
  return settings;
}

void apply_settings(const NumericalSettings& settings, RunOptions& run) {
  settings.apply(run.relaxation);
  if (settings.softening != softening_of(run)) give_softening(settings.softening, run);
}

}  // namespace floc
