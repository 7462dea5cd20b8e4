#pragma once

#include <string>
#include <vector>

#include "floc/fitting/fitted_parameter.h"

namespace floc {

/// Bulk modulus from an elastic branch of a load path, or the reason why there is no fit.
struct ElasticFit {
  std::string failure_reason;  ///< reason why there is no fit; empty if there is one
  /// Parameters B (bulk modulus, in the unit of the pressures) and phi_unloaded (solid fraction at zero pressure).
  std::vector<FittedParameter> parameters;
  /// Bulk modulus between the two lowest pressures; infinite or negative if the solid fraction does not grow between
  /// them.
  double secant_low = 0.0;
  double secant_high = 0.0;  ///< bulk modulus between the two highest pressures
  /// Root mean square residual of ln Phi over the points fitted (Phi: solid fraction).
  double rms = 0.0;
  int first = 0;     ///< index of the first point fitted
  int n_points = 0;  ///< number of points fitted: all points, unless the branch is curved
  /// True if the branch is curved. The bulk modulus B then describes only a part of the branch, or is not identified.
  bool is_curved = false;
  std::vector<std::string> warnings;

  bool found() const { return failure_reason.empty(); }
};

/// Fits the bulk modulus B to a branch of a load path. On an elastic branch, the solid fraction Phi and the pressure P
/// obey dPhi/Phi = dP/B. The function therefore fits the straight line ln Phi = ln Phi_0 + P/B by least squares.
///
/// A branch that is curved beyond its scatter has no single modulus. In this case, B is the modulus of the longest
/// straight part that contains an end of the branch and at least four pressures. A part is straight if its points lie
/// on a line within their scatter. A part is also straight if all moduli between neighbouring pressures are within 15 %
/// of B; the interval of B is then widened to contain these moduli. If no part is straight, B is not identified. The
/// solid fraction at zero pressure is identified only if the straight part reaches the lowest pressure.
///
/// The line through the whole branch may have a negative modulus, for instance because the packing collapses as the
/// pressure begins to fall. In such a branch, a part counts as straight only if, in addition, Phi falls from every
/// point to the point at the next lower pressure. If there is no straight part, there is no fit. There is also no fit
/// with fewer than three points.
/// @param P  pressures, >= 0, growing or falling   @param phi  solid fractions, in (0, 1), one per pressure
[[nodiscard]] ElasticFit fit_elastic(const std::vector<double>& P, const std::vector<double>& phi);

/// Compares the fitted bulk modulus B with B_first and B_last, the bulk moduli computed from the contact networks of
/// the first and the last fitted state. If both are above, or both below, the 95 % interval of B, removes the value of
/// B and adds a warning.
void hold_against(double B_first, double B_last, ElasticFit& fit);

}  // namespace floc
