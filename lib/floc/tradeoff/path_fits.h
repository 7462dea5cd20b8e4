#pragma once

#include <array>
#include <optional>
#include <vector>

#include "floc/tradeoff/comparison.h"

namespace floc {

/// Returns the range of reduced pressures P* in which the full consolidation law (solid fraction against pressure) is
/// fitted to each path. The range is chosen by the fit to the mean of all reference paths. Returns std::nullopt if the
/// first stage does not increase the pressure, if there are fewer than three reference paths, or if the curvature
/// towards the maximum solid fraction Phi_max is not detectable.
/// @param references  paths (equilibria) of the runs with the strictest settings, one path for each seed
std::optional<PressureWindow> fit_window(const std::vector<const SamplePath*>& references);

/// Parameters lambda, alpha and Phi_max of the consolidation law; NaN if they could not be fitted.
using ConsolidationValues = std::array<double, 3>;

/// Returns the parameters of the consolidation law fitted to the mean of several paths.
/// @param window  range of reduced pressures P* in which the law is fitted
ConsolidationValues fitted_consolidation(const std::vector<const SamplePath*>& paths,
                                         const PressureWindow& window);

/// Returns the relative differences of the parameters lambda, alpha and Phi_max of the consolidation law between
/// samples and reference paths. The law is fitted twice to the first loading: to its mean over the samples and to its
/// mean over the reference paths. Standard errors are estimated by the jackknife: the fits are repeated without one
/// sample and its reference path, for each sample in turn. For a parameter that could not be fitted, MeanDifference::n
/// is 0.
/// @param references  paths (equilibria) of the runs with the strictest settings, one path for each seed
/// @param paths  samples from the same seeds as the reference paths
/// @param window  range of reduced pressures P* in which the law is fitted
std::array<MeanDifference, 3> compare_fits(const std::vector<const SamplePath*>& references,
                                           const std::vector<const SamplePath*>& paths,
                                           const PressureWindow& window);

/// Returns the error that random sampling causes in each parameter of the consolidation law, fitted to the mean of
/// several paths. The error is the standard error by the jackknife, divided by the parameter; the member `difference`
/// is 0.
std::array<MeanDifference, 3> sampling_errors_of_fits(const std::vector<const SamplePath*>& paths,
                                                      const PressureWindow& window);

/// Returns the value of an observable that describes a whole path, such as K0 of an oedometer test. The value is NaN if
/// the path does not have this observable. It is also NaN for the parameters of the consolidation law, because the law
/// is fitted only to the mean of several paths.
double path_value(int observable, const SamplePath& path);

}  // namespace floc
