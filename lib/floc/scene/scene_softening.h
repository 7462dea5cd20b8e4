#pragma once

#include <vector>

#include "floc/contact/softened_law.h"
#include "floc/loading/run_options.h"
#include "floc/loading/run_plan.h"
#include "floc/prices/numerical_settings.h"

/// Soft springs in the parts of a run: the assembly, and the stages of the load path (docs/numerics.md, "Soft
/// collapse").
namespace floc {

/// Returns the largest factor by which springs may be softer than in the contact law, in one step of a run. For a step
/// that imposes a strain the factor is 1, because the stress at this strain depends on the stiffness.
/// @param pressure  largest pressure on the packing in this step, including the pressure at its start (stress unit of
/// the scene)
SofteningLimit softening_limit_of(const PlannedEquilibrium& step, const RunOptions& run, double pressure);

/// Returns the largest stress that a step of a run imposes on an axis (stress unit of the scene).
double largest_stress(const PlannedEquilibrium& step);

/// Returns, for each stage of the load path, whether it imposes a strain. The springs cannot be softened in such a
/// stage.
std::vector<bool> strained_stages(const RunOptions& run);

/// Returns the factors by which springs are softened in a run; for the load path, the largest factor of all stages.
Softening softening_of(const RunOptions& run);

/// Returns the largest factors that give_softening() may give a run; a factor is 1 if springs cannot be softened.
Softening largest_softening(const RunOptions& run);

/// Sets the factors by which springs are softened in all parts of a run. In stages that impose a strain, springs are
/// not softened.
void give_softening(const Softening& softening, RunOptions& run);

/// Returns the numerical settings of a run, with its softening.
NumericalSettings settings_of(const RunOptions& run);

/// Sets the numerical settings of a run. The parts of the run keep their softening if softening_of() already equals the
/// softening in the settings.
void apply_settings(const NumericalSettings& settings, RunOptions& run);

}  // namespace floc
