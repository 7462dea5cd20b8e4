#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "floc/fitting/fitted_parameter.h"
#include "floc/fitting/round_bend.h"

namespace floc {

/// Preconsolidation pressures from several constructions of soil mechanics, and warnings about constructions that fail.
struct YieldConstructions {
  /// The parameters P_c_casagrande, P_c_pacheco_silva, P_c_butterfield and P_c_becker, except those that cannot be
  /// constructed.
  std::vector<FittedParameter> parameters;
  std::vector<std::string> warnings;
};

/// Number of the resampled curves of a bootstrap, and seed of the random numbers.
struct BootstrapDraws {
  int n = 400;
  std::uint64_t seed = 1;
};

/// Finds the preconsolidation pressure P_c by graphical constructions of soil mechanics. The compression curve is y =
/// 1/Phi = 1 + e against ln P, with the solid fraction Phi and the void ratio e. The constructions are
///
/// - Casagrande [Casagrande1936]: at the point of largest curvature of y against log10 P (on the smoothing spline), the
/// tangent and the horizontal enclose an angle; the bisector of this angle meets the virgin line at P_c;
/// - Pacheco Silva [PachecoSilva1970]: the horizontal through the first y meets the virgin line; the vertical through
/// this point meets the curve; the horizontal through the point on the curve meets the virgin line at P_c;
/// - Butterfield [Butterfield1979]: two straight lines of ln y against ln P intersect at P_c;
/// - Becker [BCBJ1987]: two straight lines of the work per volume, sum P_mean d(strain), against P intersect at P_c.
///
/// The virgin line is fitted to the points above the round bend. For Butterfield and Becker, one line is fitted to the
/// points below the bend, and the other to the points above the bend. Each line is fitted to at least three points: if
/// necessary, the first three or the last three of the curve. Intervals contain 95 % of the results for resampled
/// curves, which are the smoothing spline plus drawn residuals. Each line is fitted to the same points in all curves.
/// @param P     pressures, > 0, increasing; eight or more
/// @param y     1/Phi, one per pressure
/// @param bend  round bend fitted to y against ln P
[[nodiscard]] YieldConstructions yield_constructions(const std::vector<double>& P, const Eigen::VectorXd& y,
                                                     const RoundBend& bend, const BootstrapDraws& draws = {});

/// Returns the parameter P_c_agreed, the pressure on which several methods agree. The interval is the intersection of
/// the intervals of all methods. The value is the median over the methods, limited to this interval. If the
/// intersection is empty, or if there are fewer than three methods, P_c_agreed has no value.
[[nodiscard]] FittedParameter agreed_pressure(const std::vector<FittedParameter>& methods);

}  // namespace floc
