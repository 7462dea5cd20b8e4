#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "floc/fitting/fitted_parameter.h"
#include "floc/fitting/round_bend.h"

namespace floc {

/// Preconsolidation pressure by the constructions of soil mechanics, or the reason why there is none.
struct YieldConstructions {
  /// P_c_casagrande, P_c_pacheco_silva, P_c_butterfield and P_c_becker, as far as each can be made.
  std::vector<FittedParameter> parameters;
  std::vector<std::string> warnings;
};

/// Number and seed of the resampled curves of a bootstrap.
struct BootstrapDraws {
  int n = 400;
  std::uint64_t seed = 1;
};

/// Finds the preconsolidation pressure of a compression curve of y = 1/Phi = 1 + e against ln P by constructions that are
/// made by hand on paper otherwise:
///
/// - Casagrande [Casagrande1936]: from the point of largest curvature of y against log10 P, on the smoothing spline, the
///   bisector of the horizontal and the tangent meets the virgin line;
/// - Pacheco Silva [PachecoSilva1970]: the horizontal through the first y meets the virgin line; the curve below that
///   point, carried over horizontally to the virgin line, gives the pressure;
/// - Butterfield [Butterfield1979]: two lines of ln y against ln P meet;
/// - Becker [BCBJ1987]: two lines of the work per volume, sum P_mean d(strain), against P meet.
///
/// The virgin line, and both lines of Butterfield and Becker, are fitted to the points beyond the round bend on either
/// side, or to the last and first three points if there are fewer. Intervals hold 95 % of curves whose residuals from the
/// smoothing spline are drawn again; which points belong to the lines is held.
/// @param P     pressures, > 0, growing, eight or more
/// @param y     1/Phi, one per pressure
/// @param bend  round bend fitted to y against ln P
[[nodiscard]] YieldConstructions yield_constructions(const std::vector<double>& P, const Eigen::VectorXd& y,
                                                     const RoundBend& bend, const BootstrapDraws& draws = {});

/// Returns the pressure at which several methods agree: their median, with the interval that all of their intervals
/// share. The parameter P_c_agreed has no value if they share none.
[[nodiscard]] FittedParameter agreed_pressure(const std::vector<FittedParameter>& methods);

}  // namespace floc
