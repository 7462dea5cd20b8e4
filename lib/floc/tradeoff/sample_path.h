#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "floc/loading/run.h"
#include "floc/tradeoff/deadline.h"
#include "floc/tradeoff/observables.h"
#include "floc/tradeoff/studied_setting.h"

namespace floc {

/// One equilibrium of a sample.
struct ObservedState {
  int stage = -1;  ///< index of the stage of the load path; -1: assembly
  State<2> state;
  Observation observation;
  std::vector<std::pair<int, int>> touching;  ///< pairs in contact, in the order of the contact list
  Observation settled;  ///< observables of the strict equilibrium that the state relaxes to
};

/// Equilibria of one sample at one setting, and their cost.
struct SamplePath {
  std::vector<ObservedState> states;
  double core_seconds = 0.0;    ///< processor time of assembly, loading and moduli
  double moduli_seconds = 0.0;  ///< processor time of the moduli alone
  std::string failure;          ///< reason why it stopped early; empty if it is whole
  bool out_of_time = false;

  bool whole() const { return failure.empty() && !out_of_time; }
};

/// Returns the options of a run of the scene at a setting.
RunOptions run_options(const Scene& scene, const StudiedSetting& setting, std::uint64_t seed);

/// Makes a sample: assembly from the gas, then every stage of the load path. If `reference`, a whole path of the same
/// seed, is given, each stage starts from the state from which the reference starts it. States can then be compared
/// one by one until the first collapse of the stage.
SamplePath make_sample(const RunOptions& options, const ModuliOptions& moduli, const SamplePath* reference,
                       const Deadline& deadline);

/// Sets `settled` of every state, which is relaxed further with the strict settings. A state that already satisfies
/// them does not change. The cost is not counted. Sets `failure` if this does not converge.
void settle(const RelaxationOptions& strict, const Deadline& deadline, SamplePath& path);

}  // namespace floc
