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

/// One equilibrium of a sample (of the run from one seed), with its observables.
struct ObservedState {
  int stage = -1;  ///< index of the stage of the load path; -1 for the assembly
  State<2> state;
  Observation observation;
  /// pairs of grains that touch, in the order of the contact list
  std::vector<std::pair<int, int>> touching;
  /// observables of the equilibrium to which the state relaxes with the strictest settings
  Observation settled;
};

/// All equilibria of one sample (of the run from one seed) with one numerical setting, and their processor time.
struct SamplePath {
  std::vector<ObservedState> states;
  double core_seconds = 0.0;    ///< processor time of the assembly, the load path and the elastic moduli (s)
  double moduli_seconds = 0.0;  ///< processor time of computing the elastic moduli alone (s)
  std::string failure;          ///< reason why the run stopped early; empty if it has all its equilibria
  bool out_of_time = false;

  bool whole() const { return failure.empty() && !out_of_time; }
};

/// Returns the options for running a scene with a numerical setting of the study, on one thread.
RunOptions run_options(const Scene& scene, const StudiedSetting& setting, std::uint64_t seed);

/// Makes a sample: assembles a packing from a gas, then takes it through every stage of the load path.
/// @param moduli     method and tolerance for computing the elastic moduli
/// @param reference  complete path with the strictest settings from the same seed, or null. If it is given, each stage
///                   starts from the state from which the reference starts this stage. States of both can then be
///                   compared one by one until the first collapse (sudden rearrangement of grains) in the stage.
/// @param deadline   deadline at which the run is stopped
SamplePath make_sample(const RunOptions& options, const ModuliOptions& moduli, const SamplePath* reference,
                       const Deadline& deadline);

/// Sets the member `settled` of every state: relaxes the packing further with the strictest settings and observes the
/// result. A state that already satisfies these settings does not change. The processor time for this does not count as
/// that of the path. If a state does not converge, the member `failure` of the path says so.
/// @param strict  options of the relaxation with the strictest settings
/// @param deadline  deadline at which the relaxation is stopped
/// @param path  path whose states are relaxed
void settle(const RelaxationOptions& strict, const Deadline& deadline, SamplePath& path);

}  // namespace floc
