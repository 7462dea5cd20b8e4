#pragma once

#include <array>
#include <optional>
#include <vector>

#include "floc/tradeoff/comparison.h"

namespace floc {

/// Returns the range of reduced pressures P* in which the full consolidation law (solid fraction against pressure) is
/// fitted to each path. The fit to the mean of all reference paths chooses this range. Returns std::nullopt if the
/// first stage does not increase the pressure, if there are fewer than three reference paths, or if the solid fraction
/// does not detectably bend towards its maximum Phi_max.
/// @param references  paths (equilibria) of the runs with the strictest settings, one path for each seed
std::optional<PressureWindow> fit_window(const std::vector<const SamplePath*>& references);

/// Parameters lambda, alpha and Phi_max of the consolidation law; NaN if they could not be fitted.
using ConsolidationValues = std::array<double, 3>;

/// Returns the consolidation law of the mean of several paths.
/// @param window  range of reduced pressures P* in which the law is fitted
ConsolidationValues fitted_consolidation(const std::vector<const SamplePath*>& paths,
                                         const PressureWindow& window);

/// Returns the relative differences of the parameters lambda, alpha and Phi_max of the consolidation law between
/// samples and reference paths. The law is fitted to the first loading, once as the mean over the samples and once as
/// the mean over the reference paths. Standard errors are estimated by the jackknife: the fits are repeated with each
/// pair of a sample and its reference path left out in turn. For a parameter that could not be fitted,
/// MeanDifference::n is 0.
/// @param references  paths (equilibria) of the runs with the strictest settings, one path for each seed
/// @param paths  samples from the same seeds as the reference paths
/// @param window  range of reduced pressures P* in which the law is fitted
std::array<MeanDifference, 3> compare_fits(const std::vector<const SamplePath*>& references,
                                           const std::vector<const SamplePath*>& paths,
                                           const PressureWindow& window);

/// Returns, as the standard error, the error that random sampling causes in each parameter of the consolidation law of
/// the mean of these paths, relative to the parameter, from the jackknife; the difference is 0.
std::array<MeanDifference, 3> sampling_errors_of_fits(const std::vector<const SamplePath*>& paths,
                                                      const PressureWindow& window);

/// Returns the value of an observable that follows from a single path, such as K0 of an oedometer test; NaN if the path
/// has no such value, and for the parameters of the consolidation law, which are fitted to the mean of paths.
double path_value(int observable, const SamplePath& path);

}  // namespace floc
