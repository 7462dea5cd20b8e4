#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "floc/tradeoff/sample_path.h"

namespace floc {

/// Distribution of the relative errors of an observable in single states.
struct Spread {
  double error = 0.0;  ///< 95 % quantile of the relative errors
  /// Upper 95 % confidence limit of this quantile, by order statistics. It needs at least 59 errors; with fewer it is
  /// the largest error.
  double high = 0.0;
  int n = 0;  ///< number of errors; 0 if nothing was compared
};

/// Returns the distribution of relative errors.
/// @param errors  relative errors >= 0; values that are not finite are left out
Spread spread_of(std::vector<double> errors);

/// Mean over samples of relative differences between two runs from the same seed, with its standard error. The standard
/// error and `error95` are NaN for a single sample; all members are zero if there is no sample.
struct MeanDifference {
  double difference = 0.0;
  double standard_error = 0.0;
  double error95 = 0.0;  ///< half width of the 95 % interval (Student's t)
  int n = 0;             ///< number of samples
};

/// Returns the mean of relative differences.
/// @param differences  one difference for each sample; values that are not finite are left out
MeanDifference mean_of(const std::vector<double>& differences);

/// Errors of one observable at a setting, relative to the reference path (the run with the strictest settings).
struct ObservableError {
  /// errors of states before the first collapse of a stage, each compared with the same state of the reference path
  Spread before;
  /// errors of the assembled states and of states after the first collapse of a stage, each compared with the strict
  /// equilibrium to which it relaxes
  Spread after;
  /// difference of the mean over the states in `after` from the mean of the reference path
  MeanDifference mean;
};

/// Errors of the observables of a state, in the order of `Observable`, followed by those of the quantities fitted to
/// the whole path, for which only `mean` is known.
using ObservableErrors = std::array<ObservableError, kObservables + kFittedNames.size()>;

/// Lowest and highest pressure P* of the states to which a law is fitted.
using PressureWindow = std::pair<double, double>;

/// Returns for each state of a path whether it can be compared with the same state of the reference path (the run with
/// the strictest settings), because neither path has collapsed since the stage began: both paths have moved only as far
/// as elasticity explains (3 dP/B), and the same pairs of grains touch in both. A contact that opens or closes in only
/// one of the paths separates them like a collapse does. The result is false for states of the assembly.
std::vector<bool> before_collapse(const SamplePath& reference, const SamplePath& path);

/// Returns the errors of samples, each of which is compared with the reference path of the same seed.
/// @param references  paths of the runs with the strictest settings
/// @param paths  samples; as many as references, each with as many states
/// @param window  pressures for the fits to a path; if absent, these fits are left out
ObservableErrors compare(const std::vector<const SamplePath*>& references,
                         const std::vector<const SamplePath*>& paths,
                         const std::optional<PressureWindow>& window);

/// Returns the errors of samples with another number of grains. Only the means over all states and samples are
/// compared.
ObservableErrors compare_means(const std::vector<const SamplePath*>& references,
                               const std::vector<const SamplePath*>& paths,
                               const std::optional<PressureWindow>& window);

/// Returns the errors of moduli that were computed by another method or with another tolerance for the states of the
/// reference paths.
/// @param references  paths of the runs with the strictest settings
/// @param observations  observables of each state of each reference path
ObservableErrors compare_levels(const std::vector<const SamplePath*>& references,
                                const std::vector<std::vector<Observation>>& observations);

/// Returns the sampling error of the mean over n samples like the reference paths. `mean` has the difference 0 and this
/// standard error.
/// @param references  paths of the runs with the strictest settings
ObservableErrors sampling_errors(const std::vector<const SamplePath*>& references, int n);

}  // namespace floc
