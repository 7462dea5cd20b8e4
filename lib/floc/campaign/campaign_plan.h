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
  std::optional<double> P_star;  ///< reduced pressure; nothing where axes are loaded differently
};

/// What a run of one case does.
struct CasePlan {
  std::vector<PlannedState> states;
  int threads = 1;
  double cost = 0.0;  ///< expected cost of a run: seconds on one core, to a factor of two
};

/// One run: a case with a seed.
struct CampaignRun {
  int case_number = 0;  ///< from 0
  std::uint64_t seed = 0;
  std::string directory;  ///< below that of the campaign: runs/LABEL/seed-N
};

/// Plans each case of a campaign, and checks that it reaches the states that are collected and compared.
/// @throws InputError naming the line of the campaign: for a case that is not a valid scene, for several seeds
/// where all make the same sample, for states that a case does not have
std::vector<CasePlan> plan_cases(const Campaign& campaign);

/// All runs, seeds changing first.
std::vector<CampaignRun> runs_of(const Campaign& campaign);

/// The numbers of the chosen states, ascending.
/// @throws InputError naming the line of the campaign, and the states there are, if one does not exist
std::vector<int> chosen_states(const StateChoice& choice, const CampaignCase& one, const CasePlan& plan);

/// Whether a reference applies to this case: its keys have these values there.
bool is_meant(const Reference& reference, const CampaignCase& one);

/// Text of the scene for use in another directory: what it names relative to its file is named in full.
std::string portable_scene(const Campaign& campaign);

}  // namespace floc
