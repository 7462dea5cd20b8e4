#pragma once

#include <functional>
#include <string>
#include <vector>

#include "floc/base/range.h"
#include "floc/tradeoff/comparison.h"

namespace floc {

struct TradeoffOptions {
  double budget = 600.0;  ///< seconds of processor time that the study may take
  int max_samples = 8;    ///< seeds, from the scene's own on
  static constexpr WholeRange kSamples{.least = 1, .most = 10000};
  /// Called with what is being done.
  std::function<void(const std::string&)> progress = [](const std::string&) {};
};

/// One setting, measured.
struct MeasuredSetting {
  StudiedSetting setting;
  int n_grains = 0;
  int n_samples = 0;          ///< seeds compared
  double core_seconds = 0.0;  ///< processor time of a sample, mean; of all samples for the parameter "samples"
  double moduli_seconds = 0.0;  ///< of that, for moduli
  double cost_ratio = 0.0;      ///< to the reference, of the same seeds in the same study
  ObservableErrors errors;
};

/// What a study measured, and what it did not.
struct Tradeoff {
  int n_grains = 0;  ///< of the scene that was run
  std::vector<MeasuredSetting> settings;
  /// Settings, samples or grains that the budget did not allow, runs that failed.
  std::vector<std::string> left_out;
};

/// Runs a scene at its finest settings and at several values of each parameter, all from the same seeds
/// (paired), and compares the observables that users quote.
///
/// The reference assembles and loads a sample; every setting assembles its own, then starts each stage of the
/// load path from the reference's state, so that states can be compared one by one until the first collapse.
/// Budget: the number of grains is reduced until two samples of everything are expected to fit, by the measured
/// cost of a small one; then samples are added until the next would not fit. Settings too expensive for the
/// first sample are left out. At the deadline a run is broken off.
/// @throws InputError for other numbers than a positive budget and samples in kSamples, and for a scene that starts
/// from a saved state: samples are made from the gas
Tradeoff study_tradeoff(Scene scene, const TradeoffOptions& options);

/// Settings that no other beats in both cost and error of an observable: error is the larger of the upper
/// limits before and after the first collapse.
std::vector<bool> pareto_front(const Tradeoff& tradeoff, std::size_t observable);

/// That error; not a number where nothing was compared.
double single_state_error(const ObservableError& error);

}  // namespace floc
