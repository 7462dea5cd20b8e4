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

/// One equilibrium of a sample, with its observables.
struct ObservedState {
  int stage = -1;  ///< index of the stage of the load path; -1 for the assembly
  State<2> state;
  Observation observation;
  std::vector<std::pair<int, int>> touching;  ///< pairs of grains in contact, in the order of the contact list
  Observation settled;  ///< observables of the strict equilibrium to which the state relaxes
};

/// All equilibria of one sample, made with one setting, and the processor time that they took.
struct SamplePath {
  std::vector<ObservedState> states;
  double core_seconds = 0.0;    ///< processor time of assembly, loading and moduli (s)
  double moduli_seconds = 0.0;  ///< processor time of the moduli alone (s)
  std::string failure;          ///< reason why the sample stopped early; empty if it is complete
  bool out_of_time = false;

  bool whole() const { return failure.empty() && !out_of_time; }
};

/// Returns the options for running the scene with a setting.
RunOptions run_options(const Scene& scene, const StudiedSetting& setting, std::uint64_t seed);

/// Makes a sample: the assembly from a gas, then every stage of the load path.
/// @param moduli  method and tolerance of the moduli
/// @param reference  complete path of the same seed, or null. If it is given, each stage starts from the state from
/// which the reference starts this stage. States can then be compared one by one until the first collapse of the stage.
SamplePath make_sample(const RunOptions& options, const ModuliOptions& moduli, const SamplePath* reference,
                       const Deadline& deadline);

/// Sets the member `settled` of every state, by relaxing the state further with the strict settings. A state that
/// already satisfies them does not change. The processor time of this is not added to that of the path. Sets `failure`
/// if a state does not converge.
void settle(const RelaxationOptions& strict, const Deadline& deadline, SamplePath& path);

}  // namespace floc
