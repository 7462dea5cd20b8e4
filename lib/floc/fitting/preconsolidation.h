#pragma once

#include <string>
#include <vector>

#include "floc/fitting/fitted_parameter.h"

namespace floc {

/// Fitted preconsolidation pressure, at which a reloaded packing begins to yield again, or the reason why there is no
/// fit.
struct PreconsolidationFit {
  std::string failure_reason;  ///< reason why there is no fit; empty if there is one
  /// Parameters P_c (preconsolidation pressure), kappa (slope -d(1/Phi)/dlnP below P_c, with the solid fraction Phi)
  /// and lambda (this slope above P_c). With eight pressures or more, there are also the parameters of
  /// yield_constructions(), and P_c_agreed, the pressure on which all methods agree, see agreed_pressure().
  std::vector<FittedParameter> parameters;
  double rms = 0.0;  ///< root mean square residual of 1/Phi
  std::vector<std::string> warnings;

  bool found() const { return failure_reason.empty(); }
};

/// Fits the preconsolidation pressure P_c of a reloading branch that continues beyond the largest earlier pressure, as
/// the bend of
///
///   1/Phi = y_c - kappa ln(P/P_c)  for P < P_c,   y_c - lambda ln(P/P_c)  beyond
///
/// by least squares. With ten pressures or more, the bend may be round (RoundBend); P_c is then the pressure at which
/// the two lines of the bend meet. P_c may lie between two pressures of the branch. The interval of P_c follows from
/// the profile of the sum of squares. The interval is widened if neighbouring residuals are correlated, for example
/// because the measured curve advances in jumps. There is no fit if one side of P_c has fewer than two points, if there
/// are fewer than five points in all, or if the curve does not bend towards a steeper line.
/// @param P  pressures, > 0, growing   @param phi  solid fractions, > 0, one per pressure
[[nodiscard]] PreconsolidationFit fit_preconsolidation(const std::vector<double>& P,
                                                       const std::vector<double>& phi);

}  // namespace floc
