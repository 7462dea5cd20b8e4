#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "floc/fitting/law_estimate.h"

namespace floc {

/// Result of a bootstrap: a summary of fits of one law to resampled data.
struct Resampled {
  int n = 0;  ///< number of fits that leave at least three points in regime II
  /// Mean, standard deviation and percentiles 2.5 and 97.5 of each parameter over these fits.
  std::vector<FittedParameter> parameters;
};

/// Repeats a fit on resampled data (bootstrap). For a mean curve, each fit is made to the mean of samples drawn with
/// replacement, one fewer than there are, which makes the variance unbiased. For a single curve, each fit is made to
/// the fitted values plus drawn residuals, each enlarged according to the leverage of its point.
/// @param samples  values of 1/Phi of each sample (columns) at the points of the plateau, then of the window (rows);
/// empty for a single curve
/// @param n        number of bootstrap fits, > 0
[[nodiscard]] Resampled resample(const LawEstimate& estimate, const Eigen::MatrixXd& samples, int n,
                                 std::uint64_t seed);

}  // namespace floc
