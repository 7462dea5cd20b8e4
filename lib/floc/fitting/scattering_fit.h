#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "floc/fitting/fitted_parameter.h"

namespace floc {

/// Mean intensity scattered in a bin of wave numbers.
struct ScatteredPoint {
  double k;                ///< > 0 (1/length)
  double I;                ///< > 0 (length^2)
  std::int64_t n_vectors;  ///< independent wave vectors that I is the mean of, >= 1
};

/// A fit of the scattering law of fractal aggregates of finite size (docs/physics.md, "Structure"), or the
/// reason why there is none:
///
///   I(k) = I0 / [1 + (k xi/(2 pi))^2]^(dF/2)
struct ScatteringFit {
  std::string failure_reason;               ///< empty when there is a fit
  std::vector<FittedParameter> parameters;  ///< I0, xi, dF
  double low = 0.0, high = 0.0;             ///< range of k fitted: that of the bins used
  int n_points = 0;
  double rms = 0.0;  ///< root mean square residual of ln I
  /// Residuals over the scatter of speckles, per degree of freedom; 1 for a law that holds.
  double chi_square = 0.0;
  std::vector<std::string> warnings;

  bool found() const { return failure_reason.empty(); }
};

/// Returns the intensity I(k) of the law.
double scattered_intensity(double I0, double xi, double dF, double k);

/// Fits the law by least squares in ln I over low <= k <= high. The intensity of each wave vector has the
/// exponential distribution of speckles, so that a mean over n of them has the relative variance 1/n, and its
/// logarithm a bias, which is removed. Errors are those of this scatter, or of the residuals where these are
/// larger. There is no fit with fewer than six bins.
/// @throws InputError unless low < high are finite numbers
[[nodiscard]] ScatteringFit fit_scattering(const std::vector<ScatteredPoint>& points, double low, double high);

}  // namespace floc
