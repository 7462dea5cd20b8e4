#pragma once

#include "floc/fitting/consolidation.h"

namespace floc {

/// Fits the consolidation law that a curve supports. The law is fitted to the points in the window of the options or,
/// without a window, to points of the regimes found by find_segments(). The function chooses
///
/// 1. the full law, if all of the following is true: the curve bends towards Phi_max within the data; lambda, alpha and
/// Phi_max are identified; Phi_max is below its bound; the upper end of an interval is at most three times the lower
/// end for lambda, and at most five times for alpha; the residuals of a single curve are not systematic;
/// 2. otherwise the line of regime II, fitted to the points of regime II; if possible, a power law fitted to the points
/// beyond regime II gives alpha and Phi_max, and P1* is the pressure at which regime III begins;
/// 3. the power law of regime III, if the curve has no regime II.
///
/// The points before regime II lie on a recompression line, whose slope is kappa. The yield pressure P0* is the
/// pressure at which this line meets the line of regime II. In the list of parameters, C_c = ln(10) lambda and C_s =
/// ln(10) kappa come after lambda and kappa. If the residuals of a single curve are systematic, the intervals are
/// widened.
///
/// The samples of a mean curve may collapse in jumps (collapse_jumps.h). If the curve is a mean over three samples or
/// more, a bend of the mean is therefore accepted only if samples_bend_at() finds it, and the line of regime II is
/// fitted without the points at which the samples lag behind the line.
/// @param options  options of fit_consolidation(); `law`, `regimes` and `widen` are ignored
[[nodiscard]] ConsolidationFit fit_supported_law(const ConsolidationCurve& curve, ConsolidationOptions options);

}  // namespace floc
