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

/// One equilibrium of a sample (the run from one seed), with its observables.
struct ObservedState {
  int stage = -1;       ///< index of the stage of the load path; -1 for the assembly
  std::string control;  ///< keyword for the loading of the axes in the stage; empty for the assembly
  /// stress (imposed or resulting), averaged over the axes
  double mean_stress = 0.0;
  /// load that is imposed on the driven axis: a stress, a logarithmic strain or a shear strain
  double driven_load = 0.0;
  double driven_stress = 0.0;     ///< stress on the driven axis, imposed or resulting
  double reduced_pressure = 0.0;  ///< reduced pressure P* that corresponds to `driven_stress`
  Observation observation;
  /// pairs of grains that touch, in the order of the contact list
  std::vector<std::pair<int, int>> touching;
  /// observables of the equilibrium to which the state relaxes with the strictest settings
  Observation settled;
  /// stresses and strains in this state and at the start of its test; absent unless the state belongs to a test
  std::optional<ShearPoint> test, start_of_test;
  AnyState state;
};

/// All equilibria of one sample (the run from one seed) with one numerical setting, and their processor time.
struct SamplePath {
  std::vector<ObservedState> states;
  double core_seconds = 0.0;    ///< processor time of the assembly, the load path and the elastic moduli (s)
  double moduli_seconds = 0.0;  ///< processor time of computing the elastic moduli alone (s)
  /// largest memory of the run (MB), not including the memory of the program itself; NaN if not known
  double memory = 0.0;
  std::string failure;  ///< reason why the run stopped early; empty if all its equilibria were reached
  bool out_of_time = false;

  bool whole() const { return failure.empty() && !out_of_time; }
  /// Frees the packings. The comparison of paths does not need them.
  void drop_packings();
};

/// Makes a sample: assembles a packing from a gas, then takes it through every stage of the load path.
/// @param moduli     method and tolerance for computing the elastic moduli
/// @param reference  complete path with the strictest settings from the same seed, or null. If given, each stage
///                   starts from the same state as on the reference path. States of the two paths can then be
///                   compared one by one until the first collapse (sudden rearrangement of grains) in the stage.
/// @param deadline   deadline at which the run is stopped
SamplePath make_sample(const RunOptions& options, const ModuliOptions& moduli, const SamplePath* reference,
                       const Deadline& deadline);

/// Reads a sample from the state files of a run that has ended, without the elastic moduli.
/// @param scene  scene of the run
/// @param files  names of the state files of all equilibria, in order
/// @throws InputError if a file cannot be read, or if its state has another dimension than the scene
SamplePath read_sample(const Scene& scene, const std::vector<std::string>& files);

/// Sets the member `settled` of every state: relaxes the packing further with the strictest settings and computes the
/// observables of the result. A state of elastic grains that already satisfies these settings does not change. The
/// processor time of this relaxation is not part of the processor time of the path. If a state does not converge, the
/// member `failure` of the path gives the reason.
/// @param strict  options of the relaxation with the strictest settings
/// @param deadline  deadline at which the relaxation is stopped
/// @param path  path whose states are relaxed
void settle(const RelaxationOptions& strict, const Deadline& deadline, SamplePath& path);

}  // namespace floc
