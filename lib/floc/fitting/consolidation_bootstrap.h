#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "floc/fitting/law_estimate.h"

namespace floc {

/// Summary of the fits of a consolidation law to resampled data (bootstrap).
struct Resampled {
  int n = 0;  ///< number of fits that leave at least three points to regime II
  /// Mean, standard deviation and percentiles 2.5 and 97.5 of each parameter of the law over the `n` fits.
  std::vector<FittedParameter> parameters;
};

/// Repeats the fit of a consolidation law on resampled data (bootstrap). If the curve is a mean over m samples, the law
/// is fitted to the mean of m - 1 samples, drawn with replacement; with this number, the variance is unbiased. If the
/// curve belongs to a single sample, the law is fitted to the fitted values plus drawn residuals. Each residual is
/// enlarged according to the leverage of its point.
/// @param samples  values of 1/Phi of each sample (columns) at the points of the plateau, then of the window (rows);
/// empty for a single curve
/// @param n        number of bootstrap fits, > 0
[[nodiscard]] Resampled resample(const LawEstimate& estimate, const Eigen::MatrixXd& samples, int n,
                                 std::uint64_t seed);

}  // namespace floc
