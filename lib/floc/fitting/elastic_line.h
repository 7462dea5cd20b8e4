#pragma once

#include <string>
#include <vector>

#include "floc/fitting/fitted_parameter.h"

namespace floc {

/// Bulk modulus from an elastic branch of a load path, or the reason why there is none.
struct ElasticFit {
  std::string failure_reason;  ///< reason why there is no fit; empty if there is one
  /// Bulk modulus B (unit of the pressures), phi_unloaded (solid fraction at P = 0).
  std::vector<FittedParameter> parameters;
  /// Bulk modulus between the two lowest pressures; infinite or negative if Phi does not grow there.
  double secant_low = 0.0;
  double secant_high = 0.0;  ///< bulk modulus between the two highest pressures
  double rms = 0.0;          ///< root mean square residual of ln Phi, of the points fitted
  int first = 0;             ///< index of the first point fitted, in the order given
  int n_points = 0;          ///< number of points fitted: all, unless the branch is curved
  bool is_curved = false;    ///< true if B is the modulus of a part of the branch only, or not identified
  std::vector<std::string> warnings;

  bool found() const { return failure_reason.empty(); }
};

/// Fits the bulk modulus of dPhi/Phi = dP/B: the straight line ln Phi = ln Phi_0 + P/B by least squares.
///
/// A branch that is curved beyond its scatter has no single modulus. B is then the modulus of the longest
/// straight part at either end of the branch, of at least four pressures. A part is straight if it is so within
/// its scatter, or if all moduli between neighbouring pressures are within 15 % of B; the interval of B then
/// contains these moduli. If no part is straight, B is not identified. phi_unloaded is identified only if the
/// straight part reaches the lowest pressure.
///
/// The line through a whole branch may have a negative modulus, for instance if the packing collapses as the
/// pressure begins to fall. The branch then has no single modulus either, and Phi must fall at every step of
/// the straight part. There is no fit with fewer than three points, or if such a branch has no straight part.
/// @param P  pressures, >= 0, growing or falling   @param phi  solid fractions, in (0, 1), one per pressure
[[nodiscard]] ElasticFit fit_elastic(const std::vector<double>& P, const std::vector<double>& phi);

/// Compares the fitted bulk modulus with the moduli computed from the contact networks of the first and the
/// last state fitted. Removes B, with a warning, if both moduli lie on one side of its interval.
void hold_against(double B_first, double B_last, ElasticFit& fit);

}  // namespace floc
