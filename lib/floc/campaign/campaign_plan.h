#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "floc/campaign/campaign.h"
#include "floc/scene/scene.h"

namespace floc {

/// An equilibrium that each run of a case will compute and save.
struct PlannedState {
  std::string branch;
  std::optional<double> P_star;  ///< reduced imposed pressure; absent if the axes have unequal pressures
  /// reduced imposed pressure on the driven axis, or on all axes if they have equal pressures; absent if this pressure
  /// is not known before the run
  std::optional<double> P_driven_star = {};
};

/// Plan of the runs of one case: the states, the number of threads and the cost of each run.
struct CasePlan {
  std::vector<PlannedState> states;
  int threads = 1;
  double cost = 0.0;       ///< expected processor time of a run (s, on one core): cost_of_run()
  bool is_priced = false;  ///< whether a table of prices gives this time; otherwise it is a rough estimate
};

/// A run of a campaign: a case with a seed.
struct CampaignRun {
  int case_number = 0;  ///< number of the case, counted from 0
  std::uint64_t seed = 0;
  /// Directory of the run, relative to the directory of the campaign: runs/LABEL/seed-N.
  std::string directory;
};

/// Returns the scene of a case: the scene of the campaign with the changes of the case.
/// @throws InputError naming the line of the campaign file, if the scene is not valid
Scene scene_of(const Campaign& campaign, const CampaignCase& one);

/// Plans the runs of each case of a campaign. Checks that each case has the states from which the campaign collects
/// results, or which it compares.
/// @throws InputError naming the line of the campaign file, in these cases: the scene of a case is not valid; there are
/// several seeds, but all of them give the same sample; a case does not have a state that is collected or compared
std::vector<CasePlan> plan_cases(const Campaign& campaign);

/// Returns all runs of a campaign, ordered by case and then by seed.
std::vector<CampaignRun> runs_of(const Campaign& campaign);

/// Returns the numbers of the states of a case that `choice` selects, in ascending order.
/// @throws InputError naming the line of the campaign file and the states of the case, if a selected state does not
/// exist
std::vector<int> chosen_states(const StateChoice& choice, const CampaignCase& one, const CasePlan& plan);

/// Returns whether a reference applies to a case: the case has the value in `reference.when` for every key listed
/// there.
bool is_meant(const Reference& reference, const CampaignCase& one);

/// Returns the text of the scene of a campaign. File names, which are relative to the scene file, are replaced by
/// absolute names, so that the scene can be run in another directory.
std::string portable_scene(const Campaign& campaign);

}  // namespace floc
