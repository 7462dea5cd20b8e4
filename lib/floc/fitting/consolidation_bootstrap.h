#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "floc/fitting/law_estimate.h"

namespace floc {

/// Resampled fits of one estimate.
struct Resampled {
  int n = 0;                                ///< fits that kept a regime II
  std::vector<FittedParameter> parameters;  ///< mean, standard deviation and percentiles 2.5 and 97.5
};

/// Bootstrap. For a mean, draws one sample fewer than there are, with replacement, which makes the variance
/// unbiased; for a single curve, draws its residuals, each enlarged by its leverage.
/// @param samples  1/Phi at the points of plateau and window, points x samples; empty for a single curve
/// @param n        number of draws, > 0
[[nodiscard]] Resampled resample(const LawEstimate& estimate, const Eigen::MatrixXd& samples, int n,
                                 std::uint64_t seed);

}  // namespace floc
