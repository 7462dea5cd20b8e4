#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "floc/tradeoff/sample_path.h"

namespace floc {

/// How far single values lie off, relative to their size.
struct Spread {
  double error = 0.0;  ///< 95 % of the values are at most that far off
  /// Upper 95 % confidence limit of that quantile, by order statistics. It takes 59 values: with fewer it is
  /// the largest of them.
  double high = 0.0;
  int n = 0;  ///< values; 0: nothing was compared
};

/// @param errors  >= 0; values that are not numbers are left out
Spread spread_of(std::vector<double> errors);

/// A mean of paired differences over samples, relative, with its standard error (both not a number with fewer
/// than two samples).
struct MeanDifference {
  double difference = 0.0;
  double standard_error = 0.0;
  double error95 = 0.0;  ///< half width of the 95 % interval (Student's t)
  int n = 0;             ///< samples
};

/// @param differences  one per sample; values that are not numbers are left out
MeanDifference mean_of(const std::vector<double>& differences);

/// Errors of one observable at a setting.
struct ObservableError {
  Spread before;  ///< before the first collapse of a stage: against the reference's state, from the same start
  Spread after;   ///< other states: against the strict equilibrium that each goes to when it is relaxed further
  MeanDifference mean;  ///< of those states, against the mean of the reference's
};

/// Errors of state observables, in the order of `Observable`, then of the quantities fitted to the path (`mean`
/// alone).
using ObservableErrors = std::array<ObservableError, kObservables + kFittedNames.size()>;

/// Lowest and highest pressure P* of a fit.
using PressureWindow = std::pair<double, double>;

/// For each state, whether both paths are still at the same place of configuration space: since the stage began
/// neither has moved by more than elasticity explains (3 dP/B), and the same grains have touched in both. A
/// contact that opens or closes in only one of them parts them as a collapse does. False for assembled states.
std::vector<bool> before_collapse(const SamplePath& reference, const SamplePath& path);

/// Compares samples in pairs of the same seed. @param paths  as many as references, each with as many states
/// @param window  of the fits to a path, which are left out without one
ObservableErrors compare(const std::vector<const SamplePath*>& references,
                         const std::vector<const SamplePath*>& paths,
                         const std::optional<PressureWindow>& window);

/// Compares runs of another size: ensemble means alone, over all states.
ObservableErrors compare_means(const std::vector<const SamplePath*>& references,
                               const std::vector<const SamplePath*>& paths,
                               const std::optional<PressureWindow>& window);

/// Compares another level of the moduli on the same states. @param observations  for each path, for each
/// state
ObservableErrors compare_levels(const std::vector<const SamplePath*>& references,
                                const std::vector<std::vector<Observation>>& observations);

/// Sampling error of the mean of n samples such as the references: `mean` is 0 and its standard error.
ObservableErrors sampling_errors(const std::vector<const SamplePath*>& references, int n);

}  // namespace floc
