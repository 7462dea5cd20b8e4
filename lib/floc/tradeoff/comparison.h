#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "floc/tradeoff/sample_path.h"

namespace floc {

/// Summary of the relative errors of an observable (such as the solid fraction) in single states.
struct Spread {
  double error = 0.0;  ///< 95 % quantile of the relative errors: 95 % of them are at most this large
  /// Upper 95 % confidence limit of the 95 % quantile. With at least 59 errors, the limit is one of the sorted errors
  /// (an order statistic). With fewer errors, the limit is the largest error times a factor. The factor is exact for
  /// errors that are normally distributed around zero.
  double high = 0.0;
  int n = 0;  ///< number of relative errors; 0 if no states were compared
};

/// Returns the 95 % quantile of relative errors, with its confidence limit.
/// @param errors  relative errors >= 0; values that are not finite are left out
Spread spread_of(std::vector<double> errors);

/// Relative difference between two runs with equal seeds but different settings, averaged over samples, with the
/// standard error of this mean. For a single sample, the standard error and `error95` are NaN. Without samples, all
/// members are zero.
struct MeanDifference {
  double difference = 0.0;
  double standard_error = 0.0;
  double error95 = 0.0;  ///< half width of the 95 % confidence interval of `difference` (Student's t)
  int n = 0;             ///< number of samples
};

/// Returns the mean of relative differences and its standard error.
/// @param differences  relative difference of each sample; values that are not finite are left out
MeanDifference mean_of(const std::vector<double>& differences);

/// Errors of one observable with one numerical setting, relative to the reference: the run with the strictest settings.
struct ObservableError {
  /// Errors of those states that precede the first collapse (sudden rearrangement of grains) of their stage, see
  /// before_collapse(). Each state is compared with the state of the reference at the same step.
  Spread before;
  /// Errors of all other states: of the assembly, and of each stage from its first collapse on. Each state is compared
  /// with the equilibrium to which it relaxes under the strictest settings.
  Spread after;
  /// difference of the observable from the reference, averaged over the states to which `after` applies
  MeanDifference mean;
};

/// Errors with one numerical setting, for each observable in the order of `Observable`. For observables that describe a
/// whole path, only the member `mean` is set.
using ObservableErrors = std::array<ObservableError, kObservables>;

/// Range of reduced pressures in which the consolidation law is fitted: the lowest and the highest P* (pressure divided
/// by F0/a, with the pull-off force F0 and the largest diameter a).
using PressureWindow = std::pair<double, double>;

/// Returns, for each state of a path, whether it can be compared with the state of the reference path (the run with the
/// strictest settings) at the same step. This is possible if no collapse has separated the two paths since the
/// beginning of the load stage, that is, if both conditions hold:
/// 1. On both paths the solid fraction has changed by at most 3 dP/B per step (pressure step dP, bulk modulus B).
/// Elasticity alone can explain such a change.
/// 2. The same pairs of grains touch in both states. A contact that opens or closes on only one path separates the
/// paths as a collapse does.
///
/// The result is false for states of the assembly.
std::vector<bool> before_collapse(const SamplePath& reference, const SamplePath& path);

/// Returns the errors of samples. Each sample is compared with the reference path from the same seed.
/// @param references  paths (equilibria) of the runs with the strictest settings, one path for each seed
/// @param paths  samples: as many as `references`, each with as many states as its reference path
/// @param window  range of pressures for the fits of the consolidation law; if absent, nothing is fitted
ObservableErrors compare(const std::vector<const SamplePath*>& references,
                         const std::vector<const SamplePath*>& paths,
                         const std::optional<PressureWindow>& window);

/// Returns the errors of samples that differ from the reference paths in the number of grains or in the steps of the
/// load path. Only mean differences are computed: the differences are averaged over the samples. For observables of
/// single states, they are also averaged over the states of a sample, but only over states whose loads occur on both
/// paths.
/// @param references  paths (equilibria) of the runs with the strictest settings, one path for each seed
/// @param paths  samples: as many as `references`
/// @param window  range of pressures for the fits of the consolidation law; if absent, nothing is fitted
ObservableErrors compare_means(const std::vector<const SamplePath*>& references,
                               const std::vector<const SamplePath*>& paths,
                               const std::optional<PressureWindow>& window);

/// Returns the errors of elastic moduli that were computed by another method or with another tolerance. The states are
/// the states of the reference paths.
/// @param references  paths (equilibria) of the runs with the strictest settings, one path for each seed
/// @param observations  for each reference path, the observables of each of its states, computed with these moduli
ObservableErrors compare_levels(const std::vector<const SamplePath*>& references,
                                const std::vector<std::vector<Observation>>& observations);

/// Returns the error that random sampling alone causes in a mean over n samples. It is computed from the scatter
/// between the reference paths, and is the standard error in the member `mean` of each observable. The difference in
/// `mean` is 0.
/// @param references  paths (equilibria) of the runs with the strictest settings, one path for each seed
/// @param n  number of samples
/// @param window  range of pressures for the fits of the consolidation law; if absent, nothing is fitted
ObservableErrors sampling_errors(const std::vector<const SamplePath*>& references, int n,
                                 const std::optional<PressureWindow>& window);

/// Returns the value of observable number k for one path. For an observable of single states, this value is the mean
/// over all states of the path that have a value. The result is NaN if the path has no value.
double value_of_path(std::size_t k, const SamplePath& path);

/// Returns the mean of every observable over all states and samples or, for an observable of whole paths, over the
/// samples. A mean is NaN if there is no value.
Observation mean_values(const std::vector<const SamplePath*>& paths,
                        const std::optional<PressureWindow>& window);

}  // namespace floc
