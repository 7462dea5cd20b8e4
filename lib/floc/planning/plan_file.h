#pragma once

#include <string>
#include <vector>

#include "floc/planning/plan.h"

namespace floc {

/// Files and texts that are needed to write the file of a plan.
struct PlanSource {
  std::string scene_file;              ///< path of the scene file
  std::vector<std::string> overrides;  ///< texts "key.path=value" that change the scene, see read_scene()
  std::string prices;                  ///< source of the prices, such as the name of a table of prices
  int cores = 1;                       ///< number of cores for which the plan is made
};

/// Whether an observable is a parameter of the fit of the consolidation law to paths.
bool is_fitted(const std::string& observable);

/// Returns the changes, as texts "key.path=value", that give a scene the numerical settings `settings`.
/// @throws InputError if the settings cannot be written into a scene
std::vector<std::string> changes_of(const PricedSettings& settings, const Scene& scene);

/// Returns whether a valid scene is still valid with these settings. Settings can make a scene invalid: for example, a
/// tolerance must be smaller than the pressure.
bool allows(const PlanSource& source, const Scene& scene, const PricedSettings& settings);

/// Returns the values that the scene gives to keys, and that a plan with these settings replaces, as texts such as
/// "equilibrium.patience = 7 in the scene, = 1 in the plan".
std::vector<std::string> replaced_settings(const PlanSource& source, const Scene& scene,
                                           const PricedSettings& settings);

/// Returns the text of the file of a plan. For a single sample, this file is a scene. For several samples, it is a
/// campaign file with one run for each sample and with the promised errors in its table [plan].
/// @param output  path of the file; in a campaign file, the name of the scene file is relative to the folder of this
/// file
std::string plan_file(const Plan& plan, const std::vector<ObservablePrice>& observables, const Scene& scene,
                      const PlanSource& source, const std::string& output);

}  // namespace floc
