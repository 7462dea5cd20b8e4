#pragma once

#include <array>
#include <optional>
#include <vector>

#include "floc/tradeoff/comparison.h"

namespace floc {

/// Returns the range of pressures P* in which the full consolidation law is fitted; it is the range that the fit to all
/// reference paths chooses. Returns std::nullopt if the path has no first loading, if there are fewer than three
/// samples, or if the curve does not detectably bend towards Phi_max.
/// @param references  paths of the runs with the strictest settings
std::optional<PressureWindow> fit_window(const std::vector<const SamplePath*>& references);

/// Returns the relative differences of lambda, alpha and Phi_max between paths and reference paths (runs with the
/// strictest settings), all fitted to the mean curve of the first loading. Standard errors are estimated by leaving out
/// one pair of samples after another (jackknife). `n` is 0 for a parameter that could not be fitted.
/// @param window  pressures P* in which the law is fitted
std::array<MeanDifference, kFittedNames.size()> compare_fits(const std::vector<const SamplePath*>& references,
                                                             const std::vector<const SamplePath*>& paths,
                                                             const PressureWindow& window);

}  // namespace floc
