#pragma once

#include <string>
#include <vector>

#include "floc/planning/plan.h"

namespace floc {

/// Files and texts from which the file of a plan is made.
struct PlanSource {
  std::string scene_file;              ///< path of the scene file
  std::vector<std::string> overrides;  ///< texts "key.path=value" that change the scene, see read_scene()
  std::string prices;                  ///< table of prices, or pilot, in words
};

/// Whether an observable is a parameter of the fit of the consolidation law to paths.
bool is_fitted(const std::string& observable);

/// Returns the changes of a scene, as texts "key.path=value", that give it numerical settings.
/// @throws InputError if the settings are those of a table row that a scene cannot have
std::vector<std::string> changes_of(const PricedSettings& settings, const Scene& scene);

/// Returns whether a scene without faults has none with these settings either. Some scenes refuse settings, for example
/// a tolerance that is not smaller than their pressure.
bool allows(const PlanSource& source, const Scene& scene, const PricedSettings& settings);

/// Returns the text of the file of a plan: a campaign file with one run for each sample and with the promised errors in
/// its table [plan] or, for a single sample, a scene.
/// @param output  path of the file; the name of the scene file in the campaign file is relative to it
std::string plan_file(const Plan& plan, const std::vector<ObservablePrice>& observables, const Scene& scene,
                      const PlanSource& source, const std::string& output);

}  // namespace floc
