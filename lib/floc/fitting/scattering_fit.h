#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "floc/fitting/fitted_parameter.h"

namespace floc {

/// Mean intensity scattered in a bin of wave numbers.
struct ScatteredPoint {
  double k;                ///< wave number, > 0 (1/length)
  double I;                ///< mean intensity, > 0 (length^2)
  std::int64_t n_vectors;  ///< number of independent wave vectors in the bin, >= 1
};

/// Fit of the scattering law of finite fractal aggregates (docs/physics.md, "Structure"), or the reason why there is no
/// fit. The law gives the intensity I at the wave number k. The parameters are the intensity I0 at small k, the fractal
/// dimension dF, and the length xi up to which the aggregates are fractal:
///
///   I(k) = I0 / [1 + (k xi/(2 pi))^2]^(dF/2)
struct ScatteringFit {
  std::string failure_reason;               ///< reason why there is no fit; empty if there is one
  std::vector<FittedParameter> parameters;  ///< parameters I0, xi, dF of the law
  double low = 0.0, high = 0.0;             ///< smallest and largest wave number k of the bins fitted
  int n_points = 0;
  double rms = 0.0;  ///< root mean square residual of ln I
  /// Chi squared per degree of freedom. Chi squared is the sum, over all bins, of the squared residual of ln I divided
  /// by the variance of ln I due to speckles. The value is near 1 if the data follow the law.
  double chi_square = 0.0;
  std::vector<std::string> warnings;

  bool found() const { return failure_reason.empty(); }
};

/// Returns the intensity I(k) by the scattering law of ScatteringFit.
double scattered_intensity(double I0, double xi, double dF, double k);

/// Fits the scattering law by least squares in ln I to the bins with low <= k <= high. The intensities at single wave
/// vectors have an exponential distribution (speckles). A mean over n wave vectors therefore has the relative variance
/// 1/n. The logarithm of this mean has a bias, which is removed. Standard errors follow from the variance 1/n or, if
/// the residuals are larger, from the residuals. There is no fit with fewer than six bins.
/// @throws InputError unless `low` and `high` are finite numbers with low < high
[[nodiscard]] ScatteringFit fit_scattering(const std::vector<ScatteredPoint>& points, double low, double high);

}  // namespace floc
