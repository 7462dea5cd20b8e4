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
  std::vector<std::pair<int, int>> touching;  ///< grains in contact, in the order of the contact list
  Observation settled;  ///< of the strict equilibrium that the state reaches when relaxed further
};

/// Equilibria of one sample at one setting, and what they cost.
struct SamplePath {
  std::vector<ObservedState> states;
  double core_seconds = 0.0;    ///< processor time of assembly, loading and moduli
  double moduli_seconds = 0.0;  ///< of the moduli alone
  std::string failure;          ///< why it stopped short; empty when it is whole
  bool out_of_time = false;

  bool whole() const { return failure.empty() && !out_of_time; }
};

/// Options of a run of the scene at a setting.
RunOptions run_options(const Scene& scene, const StudiedSetting& setting, std::uint64_t seed);

/// Makes a sample: assembly from the gas, then every stage of the load path. With `reference`, a whole path of
/// the same seed, each stage starts from the state that the reference starts it from, so that states can be
/// compared one by one until the first collapse of the stage.
SamplePath make_sample(const RunOptions& options, const ModuliOptions& moduli, const SamplePath* reference,
                       const Deadline& deadline);

/// Fills in `settled`: every state is relaxed further with the strict settings, from where it is. A state that
/// meets them stays. The cost is not counted. Sets `failure` where this does not converge.
void settle(const RelaxationOptions& strict, const Deadline& deadline, SamplePath& path);

}  // namespace floc
