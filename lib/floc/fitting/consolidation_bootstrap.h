#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "floc/fitting/law_estimate.h"

namespace floc {

/// Result of a bootstrap: a summary of fits of one law to resampled data.
struct Resampled {
  int n = 0;                                ///< number of fits that have a regime II
  std::vector<FittedParameter> parameters;  ///< mean, standard deviation and percentiles 2.5 and 97.5
};

/// Repeats a fit on resampled data (bootstrap). For a mean curve, draws samples with replacement, one fewer
/// than there are, which makes the variance unbiased. For a single curve, draws its residuals, each enlarged by
/// its leverage.
/// @param samples  values of 1/Phi at the points of plateau and window, points x samples; empty for a single
/// curve
/// @param n        number of fits, > 0
[[nodiscard]] Resampled resample(const LawEstimate& estimate, const Eigen::MatrixXd& samples, int n,
                                 std::uint64_t seed);

}  // namespace floc
