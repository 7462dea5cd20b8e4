#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "floc/io/state_file.h"
#include "floc/loading/run.h"
#include "floc/tradeoff/deadline.h"
#include "floc/tradeoff/observables.h"
#include "floc/tradeoff/studied_setting.h"

namespace floc {

/// One equilibrium of a sample (of the run from one seed), with its observables.
struct ObservedState {
  int stage = -1;              ///< index of the stage of the load path; -1 for the assembly
  std::string control;         ///< keyword of the stage for how the axes are loaded; empty for the assembly
  double mean_stress = 0.0;    ///< mean over the axes of the stress, imposed or carried (stress)
  double driven_load = 0.0;    ///< imposed on the driven axis: a stress, or the sheared or logarithmic strain
  double driven_stress = 0.0;  ///< stress on the driven axis, imposed or carried (stress)
  double reduced_pressure = 0.0;  ///< P* of `driven_stress`
  Observation observation;
  /// pairs of grains that touch, in the order of the contact list
  std::vector<std::pair<int, int>> touching;
  /// observables of the equilibrium to which the state relaxes with the strictest settings
  Observation settled;
  /// stresses and strains of a test that drives an axis, in this state and where it began
  std::optional<ShearPoint> test, start_of_test;
  AnyState state;
};

/// All equilibria of one sample (of the run from one seed) with one numerical setting, and their processor time.
struct SamplePath {
  std::vector<ObservedState> states;
  double core_seconds = 0.0;    ///< processor time of the assembly, the load path and the elastic moduli (s)
  double moduli_seconds = 0.0;  ///< processor time of computing the elastic moduli alone (s)
  double memory = 0.0;          ///< largest memory of the run beside the program (MB); NaN if not known
  std::string failure;          ///< reason why the run stopped early; empty if it has all its equilibria
  bool out_of_time = false;

  bool whole() const { return failure.empty() && !out_of_time; }
  /// Frees the packings, of which the comparison of paths needs nothing.
  void drop_packings();
};

/// Makes a sample: assembles a packing from a gas, then takes it through every stage of the load path.
/// @param moduli     method and tolerance for computing the elastic moduli
/// @param reference  complete path with the strictest settings from the same seed, or null. If it is given, each stage
///                   starts from the state from which the reference starts this stage. States of both can then be
///                   compared one by one until the first collapse (sudden rearrangement of grains) in the stage.
/// @param deadline   deadline at which the run is stopped
SamplePath make_sample(const RunOptions& options, const ModuliOptions& moduli, const SamplePath* reference,
                       const Deadline& deadline);

/// Sets the member `settled` of every state: relaxes the packing further with the strictest settings and observes the
/// result. A state of elastic grains that already satisfies these settings does not change. The processor time for this
/// does not count as that of the path. If a state does not converge, the member `failure` of the path says so.
/// @param strict  options of the relaxation with the strictest settings
/// @param deadline  deadline at which the relaxation is stopped
/// @param path  path whose states are relaxed
void settle(const RelaxationOptions& strict, const Deadline& deadline, SamplePath& path);

}  // namespace floc
