#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "floc/tradeoff/sample_path.h"

namespace floc {

/// Distribution of the relative errors of single values.
struct Spread {
  double error = 0.0;  ///< 95 % quantile of the relative errors
  /// Upper 95 % confidence limit of this quantile, by order statistics. It needs 59 values; with fewer it is the
  /// largest of them.
  double high = 0.0;
  int n = 0;  ///< number of values; 0: nothing was compared
};

/// Returns the distribution of relative errors. @param errors  >= 0; values that are not numbers are left out
Spread spread_of(std::vector<double> errors);

/// Mean of paired relative differences over samples, with its standard error; both are NaN with fewer than two
/// samples.
struct MeanDifference {
  double difference = 0.0;
  double standard_error = 0.0;
  double error95 = 0.0;  ///< half width of the 95 % interval (Student's t)
  int n = 0;             ///< number of samples
};

/// Returns the mean of differences. @param differences  one per sample; values that are not numbers are left out
MeanDifference mean_of(const std::vector<double>& differences);

/// Errors of one observable at a setting.
struct ObservableError {
  Spread before;        ///< before the first collapse of a stage: against the state of the reference
  Spread after;         ///< other states: against the strict equilibrium that each relaxes to
  MeanDifference mean;  ///< mean over those other states, against that of the reference
};

/// Errors of state observables, in the order of `Observable`, then of the quantities fitted to the path (`mean`
/// alone).
using ObservableErrors = std::array<ObservableError, kObservables + kFittedNames.size()>;

/// Lowest and highest pressure P* of a fit.
using PressureWindow = std::pair<double, double>;

/// Returns for each state whether both paths are still at the same place of configuration space: since the stage
/// began, neither has moved by more than elasticity explains (3 dP/B), and the same grains have touched in both. A
/// contact that opens or closes in only one of them separates the paths as a collapse does. False for assembled
/// states.
std::vector<bool> before_collapse(const SamplePath& reference, const SamplePath& path);

/// Compares samples in pairs of the same seed.
/// @param paths   as many as references, each with as many states
/// @param window  pressures of the fits to a path; without it these fits are left out
ObservableErrors compare(const std::vector<const SamplePath*>& references,
                         const std::vector<const SamplePath*>& paths,
                         const std::optional<PressureWindow>& window);

/// Compares runs with another number of grains: ensemble means alone, over all states.
ObservableErrors compare_means(const std::vector<const SamplePath*>& references,
                               const std::vector<const SamplePath*>& paths,
                               const std::optional<PressureWindow>& window);

/// Compares another level of the moduli on the same states. @param observations  by path, then by state
ObservableErrors compare_levels(const std::vector<const SamplePath*>& references,
                                const std::vector<std::vector<Observation>>& observations);

/// Returns the sampling error of the mean of n samples such as the references: `mean` has the difference 0 and this
/// standard error.
ObservableErrors sampling_errors(const std::vector<const SamplePath*>& references, int n);

}  // namespace floc
