#pragma once

#include <functional>
#include <string>
#include <vector>

#include "floc/base/range.h"
#include "floc/tradeoff/comparison.h"

namespace floc {

struct TradeoffOptions {
  double budget = 600.0;  ///< seconds of processor time that the study may take
  int max_samples = 8;    ///< number of seeds, beginning with that of the scene
  static constexpr WholeRange kSamples{.least = 1, .most = 10000};
  /// Called with a description of the present work.
  std::function<void(const std::string&)> progress = [](const std::string&) {};
};

/// One setting, measured.
struct MeasuredSetting {
  StudiedSetting setting;
  int n_grains = 0;
  int n_samples = 0;            ///< number of seeds compared
  double core_seconds = 0.0;    ///< mean processor time of a sample; of all for the parameter "samples"
  double moduli_seconds = 0.0;  ///< part of it for the moduli
  double cost_ratio = 0.0;      ///< relative to the reference with the same seeds in the same study
  ObservableErrors errors;
};

/// Results of a study: the measured settings, and those left out.
struct Tradeoff {
  int n_grains = 0;  ///< number of grains of the scene that was run
  std::vector<MeasuredSetting> settings;
  /// Settings, samples or grains that the budget did not allow, and runs that failed.
  std::vector<std::string> left_out;
};

/// Runs a scene at its finest settings and at several values of each parameter, all from the same seeds (paired), and
/// compares the observables that users quote.
///
/// The reference assembles and loads a sample. Every setting assembles its own sample, then starts each stage of the
/// load path from the state of the reference, so that states can be compared one by one until the first collapse. To
/// keep the budget, the number of grains is reduced until two samples of every setting are expected to fit, by the
/// measured cost of a small one; then samples are added until the next one would not fit. Settings too expensive for
/// the first sample are left out. A run that reaches the deadline is stopped.
/// @throws InputError unless the budget is positive and the number of samples in kSamples, and for a scene that
/// starts from a saved state, because samples are made from the gas
Tradeoff study_tradeoff(Scene scene, const TradeoffOptions& options);

/// Returns for each setting whether no other one is better in both cost and error of an observable. The error is the
/// larger of the upper limits before and after the first collapse.
std::vector<bool> pareto_front(const Tradeoff& tradeoff, std::size_t observable);

/// Returns the error that pareto_front() compares; NaN if nothing was compared.
double single_state_error(const ObservableError& error);

}  // namespace floc
