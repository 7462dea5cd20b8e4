#pragma once

#include <functional>
#include <string>
#include <vector>

#include "floc/base/range.h"
#include "floc/tradeoff/comparison.h"

namespace floc {

struct TradeoffOptions {
  double budget = 600.0;  ///< processor time that the study may take (s)
  int max_samples = 8;    ///< largest number of samples, whose seeds begin with that of the scene
  static constexpr WholeRange kSamples{.least = 1, .most = 10000};
  /// Function that is called with a description of the work that has just been done.
  std::function<void(const std::string&)> progress = [](const std::string&) {};
};

/// One setting with its measured cost and errors.
struct MeasuredSetting {
  StudiedSetting setting;
  int n_grains = 0;
  int n_samples = 0;  ///< number of samples (seeds) that were compared
  /// mean processor time of a sample (s); for the parameter "samples", the sum over all samples
  double core_seconds = 0.0;
  double moduli_seconds = 0.0;  ///< part of core_seconds that the moduli took (s)
  double cost_ratio = 0.0;      ///< processor time over that of the strictest settings with the same seeds
  ObservableErrors errors;
};

/// Results of a study: the measured settings, and a list of those that were left out.
struct Tradeoff {
  int n_grains = 0;  ///< number of grains of the samples
  std::vector<MeasuredSetting> settings;
  /// Descriptions of settings, samples or grains that the budget did not allow, and of runs that failed.
  std::vector<std::string> left_out;
};

/// Studies how numerical settings trade processor time for accuracy. Runs a scene with its strictest settings (the
/// reference) and with several values of each parameter, all from the same seeds, and compares the observables that are
/// usually reported.
///
/// The reference assembles and loads a sample. For every other setting a sample is assembled with this setting; then
/// each stage of the load path starts from the state of the reference, so that states can be compared one by one until
/// the first collapse. To keep the budget, the cost is measured on a small sample, and the number of grains is reduced
/// until two samples of every setting are expected to fit. Then samples are added until the next one would not fit.
/// Settings that are too expensive for the first sample are left out. A run that reaches the deadline is stopped.
/// @throws InputError if the budget is not positive, if the number of samples is outside of kSamples, or if the scene
/// starts from a saved state, because samples are made from a gas
Tradeoff study_tradeoff(Scene scene, const TradeoffOptions& options);

/// Returns for each setting whether it is Pareto-optimal: no other setting has both a smaller processor time and a
/// smaller error of an observable (see single_state_error()).
/// @param observable  index of the observable in ObservableErrors
std::vector<bool> pareto_front(const Tradeoff& tradeoff, std::size_t observable);

/// Returns the error of an observable in single states: the larger of the upper confidence limits before and after the
/// first collapse; NaN if nothing was compared.
double single_state_error(const ObservableError& error);

}  // namespace floc
