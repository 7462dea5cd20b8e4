#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "floc/campaign/campaign.h"

namespace floc {

/// One equilibrium that a run of a case makes.
struct PlannedState {
  std::string branch;
  std::optional<double> P_star;  ///< reduced pressure; none if axes are loaded differently
};

/// Plan of the runs of one case: their states, threads and cost.
struct CasePlan {
  std::vector<PlannedState> states;
  int threads = 1;
  double cost = 0.0;  ///< expected cost of a run: seconds on one core, to a factor of two
};

/// One run: a case with a seed.
struct CampaignRun {
  int case_number = 0;  ///< from 0
  std::uint64_t seed = 0;
  std::string directory;  ///< below the directory of the campaign: runs/LABEL/seed-N
};

/// Plans each case of a campaign, and checks that it reaches the states that are collected and compared.
/// @throws InputError naming the line of the campaign for a case that is not a valid scene, for several seeds if all
/// of them make the same sample, or for states that a case does not have
std::vector<CasePlan> plan_cases(const Campaign& campaign);

/// Returns all runs, case by case; the seed changes first.
std::vector<CampaignRun> runs_of(const Campaign& campaign);

/// Returns the numbers of the chosen states, ascending.
/// @throws InputError naming the line of the campaign and the existing states if a chosen one does not exist
std::vector<int> chosen_states(const StateChoice& choice, const CampaignCase& one, const CasePlan& plan);

/// Whether a reference applies to this case: whether the keys of the reference have the values of the case.
bool is_meant(const Reference& reference, const CampaignCase& one);

/// Returns the text of the scene for use in another directory: paths relative to its file are replaced by full paths.
std::string portable_scene(const Campaign& campaign);

}  // namespace floc
