#pragma once

#include <string>
#include <vector>

#include "floc/fitting/fitted_parameter.h"

namespace floc {

/// Bulk modulus of a branch, or the reason why there is none.
struct ElasticFit {
  std::string failure_reason;               ///< empty when there is a fit
  std::vector<FittedParameter> parameters;  ///< B (unit of the pressures), phi_unloaded (at P = 0)
  /// B between the two lowest pressures; infinite or negative if Phi does not grow there.
  double secant_low = 0.0;
  double secant_high = 0.0;  ///< B between the two highest
  double rms = 0.0;          ///< root mean square residual of ln Phi, of the points fitted
  int first = 0;             ///< index of the first point fitted, in the order given
  int n_points = 0;          ///< number of points fitted: all, unless the branch is curved
  bool is_curved = false;    ///< whether B is that of a part of the branch, or not identified
  std::vector<std::string> warnings;

  bool found() const { return failure_reason.empty(); }
};

/// Fits the bulk modulus of dPhi/Phi = dP/B: the straight line ln Phi = ln Phi_0 + P/B by least squares.
///
/// A branch that is curved beyond its scatter has no single modulus. Then B is that of the longest straight
/// part at one end of it, at least four pressures: straight within its scatter, or with moduli between
/// neighbouring pressures that are within 15 % of B, all of which its interval then contains. Without such a
/// part B is not identified. phi_unloaded is identified where the part reaches the lowest pressure.
///
/// A branch that does not fall as a whole, such as one whose packing collapses as the pressure begins to fall,
/// has no single modulus either: the straight part then has to fall at every step. There is no fit with fewer
/// than three points, or without such a part.
/// @param P    pressures, >= 0, growing or falling   @param phi  solid fractions, in (0, 1); as many
[[nodiscard]] ElasticFit fit_elastic(const std::vector<double>& P, const std::vector<double>& phi);

/// Removes B, with a warning, if the moduli computed from the states at both ends of the points fitted lie
/// entirely outside its interval.
void hold_against(double B_first, double B_last, ElasticFit& fit);

}  // namespace floc
