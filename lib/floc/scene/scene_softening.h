#pragma once

#include <vector>

#include "floc/contact/softened_law.h"
#include "floc/loading/run_options.h"
#include "floc/loading/run_plan.h"
#include "floc/prices/numerical_settings.h"

/// Soft springs in the parts of a run: the assembly, and the stages of the load path (docs/numerics.md, "Soft
/// collapse").
namespace floc {

/// Returns the largest factor by which springs may be softer in a step of a run. A step that imposes a strain allows
/// none, because the stress then follows from the stiffness.
/// @param pressure  largest pressure on the packing in this step, also at its start (stress unit of the scene)
SofteningLimit softening_limit_of(const PlannedEquilibrium& step, const RunOptions& run, double pressure);

/// Returns the largest stress that a step of a run imposes on an axis (stress unit of the scene).
double largest_stress(const PlannedEquilibrium& step);

/// Returns for each stage of the load path whether it imposes a strain, so that its springs cannot be softer.
std::vector<bool> strained_stages(const RunOptions& run);

/// Returns the factors of a run.
Softening softening_of(const RunOptions& run);

/// Returns the largest factors that give_softening() may give a run; 1 where springs cannot be softer.
Softening largest_softening(const RunOptions& run);

/// Gives all parts of a run new factors. Stages that impose a strain keep the springs of the contact law.
void give_softening(const Softening& softening, RunOptions& run);

/// Returns the numerical settings of a run, with its softening.
NumericalSettings settings_of(const RunOptions& run);

/// Gives a run numerical settings. Parts of the run keep their own softening if it is that of the settings as a whole.
void apply_settings(const NumericalSettings& settings, RunOptions& run);

}  // namespace floc
