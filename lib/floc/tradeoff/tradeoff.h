#pragma once

#include <functional>
#include <string>
#include <vector>

#include "floc/base/range.h"
#include "floc/tradeoff/comparison.h"

namespace floc {

struct TradeoffOptions {
  double budget = 600.0;  ///< processor time that the study may take (s)
  /// largest number of samples; the first sample has the seed of the scene, and each further sample the next seed
  int max_samples = 8;
  static constexpr WholeRange kSamples{.least = 1, .most = 10000};
  /// parameters whose values are compared (DeclaredSetting::parameter); empty: all
  std::vector<std::string> parameters;
  /// Function that is called after each part of the work, with a description of it.
  std::function<void(const std::string&)> progress = [](const std::string&) {};
};

/// One variant of the scene (StudiedSetting) with its measured cost and errors.
struct MeasuredSetting {
  StudiedSetting setting;
  int n_grains = 0;
  int n_samples = 0;  ///< number of samples (seeds) that were compared
  /// mean processor time of a sample (s); for the parameter "samples", the sum over all samples
  double core_seconds = 0.0;
  /// mean processor time of computing the elastic moduli of a sample (s); core_seconds includes it
  double moduli_seconds = 0.0;
  /// processor time of the samples, divided by the processor time with the strictest settings from the same seeds
  double cost_ratio = 0.0;
  /// largest memory of a sample (MB), not including the memory of the program itself; NaN if not known
  double memory = 0.0;
  ObservableErrors errors;
};

/// Results of a study: the variants of the scene that were measured, and a list of those that were left out.
struct Tradeoff {
  int n_grains = 0;  ///< number of grains of a sample with the strictest settings
  int n_states = 0;  ///< number of states (equilibria) of a sample
  /// Mean of each observable over the states and samples with the strictest settings, in the unit that unit_of()
  /// returns.
  Observation reference;
  /// Scatter of each observable between samples. The observable is averaged over the states of each sample. The
  /// standard deviation of these averages is divided by their mean. NaN for a single sample.
  Observation scatter;
  std::vector<MeasuredSetting> settings;
  /// Descriptions of variants, samples or grains that did not fit into the budget, and of runs that failed.
  std::vector<std::string> left_out;
};

/// Studies the errors of runs with cheaper numerical settings, and the processor time that these settings save. The
/// study runs a scene with its strictest settings (the reference) and with several values of each parameter, all from
/// the same seeds, and compares the observables that are usually reported.
///
/// With every setting, a packing is assembled and taken through the load path. Unless the number of grains differs,
/// each stage starts from the same state as on the reference path. States can then be compared one by one until the
/// first collapse of the stage.
///
/// The study keeps its budget as follows:
/// 1. The processor time is measured on a small sample. The number of grains is reduced until two samples with every
/// setting are expected to fit into the budget.
/// 2. Samples are added until the next one would not fit. A setting that is too expensive in the first sample is left
/// out of the study.
/// 3. A run is stopped if it reaches the deadline, or if it takes more than about 1.5 times as long as the run with the
/// strictest settings.
///
/// A scene that starts from a saved packing keeps its number of grains. If its states do not depend on the seed either,
/// there is only one sample, and the errors are computed from the states of this sample alone.
/// @throws InputError if the budget is not positive, if the number of samples is outside of kSamples, or if a study of
/// the scene does not vary one of the given parameters
Tradeoff study_tradeoff(Scene scene, const TradeoffOptions& options);

/// Requires valid numbers in the options of a study. @throws InputError if the budget or the number of samples is not
/// valid
void require_study(const TradeoffOptions& options);

/// Returns the largest number of samples of a study. If it is smaller than the number in `options`, adds the reason to
/// `left_out`.
int number_of_samples(const Scene& scene, const TradeoffOptions& options, std::vector<std::string>& left_out);

/// Fills the members of `out` that describe the reference paths of a study: n_states, reference and scatter.
/// @param references  paths of the runs with the strictest settings, one path for each seed; at least one path
void describe_reference(const std::vector<const SamplePath*>& references,
                        const std::optional<PressureWindow>& window, Tradeoff& out);

/// Returns a setting with the cost of its samples, but without errors.
/// @param scene  scene of the study
/// @param references  paths of the runs with the strictest settings from the same seeds as `paths`
MeasuredSetting cost_of(const Scene& scene, const StudiedSetting& setting,
                        const std::vector<const SamplePath*>& references,
                        const std::vector<const SamplePath*>& paths);

/// Adds results for the parameter "samples": the error of a mean over 1, 2, 4, ... samples. This error is computed from
/// the scatter between samples with the strictest settings.
void add_sample_numbers(const Scene& scene, const StudiedSetting& strict,
                        const std::vector<const SamplePath*>& references,
                        const std::optional<PressureWindow>& window, Tradeoff& out);

/// Returns, for each setting of a study, whether the setting is Pareto-optimal for an observable. Pareto-optimal means:
/// no other setting is cheaper and at least as accurate, or more accurate and at least as cheap. The accuracy is
/// measured by single_state_error().
/// @param observable  index of the observable in ObservableErrors
std::vector<bool> pareto_front(const Tradeoff& tradeoff, std::size_t observable);

/// Returns the error of an observable in single states: the larger of the two upper confidence limits for states before
/// and after the first collapse of a stage; NaN if no states were compared.
double single_state_error(const ObservableError& error);

}  // namespace floc
