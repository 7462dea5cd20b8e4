#pragma once

#include <string>
#include <vector>

#include "floc/fitting/fitted_parameter.h"

namespace floc {

/// Pressure at which a reloaded packing begins to yield again, or the reason why it cannot be determined.
struct PreconsolidationFit {
  std::string failure_reason;  ///< empty when there is a fit
  /// P_c, kappa (slope -d(1/Phi)/dlnP on reloading), lambda (beyond P_c).
  std::vector<FittedParameter> parameters;
  double rms = 0.0;  ///< root mean square residual of 1/Phi
  std::vector<std::string> warnings;

  bool found() const { return failure_reason.empty(); }
};

/// Fits the preconsolidation pressure of a reloading branch that continues beyond the largest pressure before:
/// the bend of
///
///   1/Phi = y_c - kappa ln(P/P_c)  for P < P_c,   y_c - lambda ln(P/P_c)  beyond
///
/// by least squares, continuous at P_c, which is searched for between the pressures. Its interval comes from
/// the profile of the sum of squares, and is wider where neighbouring residuals are correlated, as along a
/// round bend. There is no fit with fewer than two points on either side, with fewer than five in all, or
/// without a bend towards a steeper line.
/// @param P    pressures, > 0, growing   @param phi  solid fractions, > 0; as many
[[nodiscard]] PreconsolidationFit fit_preconsolidation(const std::vector<double>& P,
                                                       const std::vector<double>& phi);

}  // namespace floc
