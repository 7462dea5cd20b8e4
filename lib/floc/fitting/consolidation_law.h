#pragma once

#include <cmath>

namespace floc {

/// Returns the function g(x) of the consolidation law, the bracket in Eq. 9 of [GRC2008]. The argument is x =
/// ln(P*/P1*), where P* is the reduced pressure, and P1* the reduced pressure at which regime III begins:
///
///   g(x) = ln{ e^x [1 - exp(-u)]^(1/alpha) },  u = exp(-alpha x) = (P1*/P*)^alpha
///
/// g tends to x far below P1*, and to -u/(2 alpha) far above P1*. T is any scalar type (`double`, Ceres' Jet). The
/// result is exact to rounding from P*/P1* = 1e-12 to 1e12. The formula of the paper would lose all digits far from
/// P1*.
/// @param alpha  exponent of the power law in regime III, > 0
template <class T>
T consolidation_bracket(const T& x, const T& alpha) {
  using std::exp, std::expm1, std::log, std::log1p;
  const T log_u = -alpha * x;
  // For larger log_u, exp(-u) is below the smallest double, so that g = x.
  if (log_u > T(6.7)) return x;
  const T u = exp(log_u);
  if (u > T(1.0)) return x + log1p(-exp(-u)) / alpha;
  if (u > T(0.1)) return log(-expm1(-u) / u) / alpha;
  // ln[(1 - e^-u)/u] = -u/2 + ln[sinh(u/2)/(u/2)]. The first neglected term of the series, u^10/4.8e8, is below
  // rounding.
  const T u2 = u * u;
  return (-u / 2.0 + u2 * (1.0 / 24.0 - u2 * (1.0 / 2880.0 - u2 * (1.0 / 181440.0 - u2 / 9676800.0)))) / alpha;
}

/// Parameters of the full law of consolidation, which gives the solid fraction Phi at the reduced pressure P*:
///
///   1/Phi = 1/Phi_max - lambda g(ln(P*/P1*))
///
/// The function g is consolidation_bracket(). Eq. 9 of [GRC2008] is the same law, but written with a pressure P0* on
/// the line of regime II and its solid fraction Phi0, where 1/Phi0 = 1/Phi_max + lambda ln(P1*/P0*).
struct ConsolidationLawParameters {
  double lambda;   ///< plasticity index, the slope -d(1/Phi)/dlnP* in regime II, > 0
  double alpha;    ///< exponent of the power law in regime III, > 0
  double phi_max;  ///< limit of the solid fraction at high pressure
  double P1_star;  ///< reduced pressure at which regime III begins, > 0

  /// Returns 1/Phi, the inverse solid fraction, at the reduced pressure P* > 0.
  double inverse_phi(double P_star) const {
    return 1.0 / phi_max - lambda * consolidation_bracket(std::log(P_star / P1_star), alpha);
  }
};

}  // namespace floc
