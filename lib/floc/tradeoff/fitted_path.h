#pragma once

#include <array>
#include <optional>
#include <vector>

#include "floc/tradeoff/comparison.h"

namespace floc {

/// Returns the pressures P* that the full law is fitted to: those that the fit of all references chooses. None if
/// there is no first loading, if there are fewer than three samples, or if no bend towards Phi_max is detected.
std::optional<PressureWindow> fit_window(const std::vector<const SamplePath*>& references);

/// Returns the differences of lambda, alpha and Phi_max, fitted to the mean curve of the first loading, relative to
/// those of the references. Standard errors follow from leaving out one pair of samples after another. `n` is 0 for a
/// parameter without a fit.
std::array<MeanDifference, kFittedNames.size()> compare_fits(const std::vector<const SamplePath*>& references,
                                                             const std::vector<const SamplePath*>& paths,
                                                             const PressureWindow& window);

}  // namespace floc
