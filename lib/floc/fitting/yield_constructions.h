#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "floc/fitting/fitted_parameter.h"
#include "floc/fitting/round_bend.h"

namespace floc {

/// Preconsolidation pressure by the constructions of soil mechanics, or the reason why there is none.
struct YieldConstructions {
  /// P_c_casagrande, P_c_pacheco_silva, P_c_butterfield and P_c_becker; those that cannot be constructed are
  /// left out.
  std::vector<FittedParameter> parameters;
  std::vector<std::string> warnings;
};

/// Number and seed of the resampled curves of a bootstrap.
struct BootstrapDraws {
  int n = 400;
  std::uint64_t seed = 1;
};

/// Finds the preconsolidation pressure of a compression curve of y = 1/Phi = 1 + e against ln P with graphical
/// constructions of soil mechanics:
///
/// - Casagrande [Casagrande1936]: the tangent and the horizontal through the point of largest curvature of y
/// against log10 P, on the smoothing spline, enclose an angle, whose bisector meets the virgin line at this
/// pressure;
/// - Pacheco Silva [PachecoSilva1970]: the horizontal through the first y meets the virgin line; a vertical
/// line from there meets the curve; the horizontal from there meets the virgin line again, at this pressure;
/// - Butterfield [Butterfield1979]: two straight lines of ln y against ln P intersect;
/// - Becker [BCBJ1987]: two straight lines of the work per volume, sum P_mean d(strain), against P intersect.
///
/// The virgin line, and both lines of Butterfield and of Becker, are fitted to the points beyond the round bend
/// on either side, but to the last and the first three points at least. Intervals hold 95 % of the results for
/// curves with resampled residuals from the smoothing spline. The points that belong to each line stay fixed.
/// @param P     pressures, > 0, increasing; eight or more
/// @param y     1/Phi, one per pressure
/// @param bend  round bend fitted to y against ln P
[[nodiscard]] YieldConstructions yield_constructions(const std::vector<double>& P, const Eigen::VectorXd& y,
                                                     const RoundBend& bend, const BootstrapDraws& draws = {});

/// Returns the pressure on which several methods agree: the median of their values, with the intersection of
/// their intervals. The parameter P_c_agreed has no value if this intersection is empty.
[[nodiscard]] FittedParameter agreed_pressure(const std::vector<FittedParameter>& methods);

}  // namespace floc
