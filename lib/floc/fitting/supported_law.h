#pragma once

#include "floc/fitting/consolidation.h"

namespace floc {

/// Fits the consolidation law that a curve supports, with the regimes found by find_segments(), or in the window of the
/// options:
///
/// 1. the full law, if the curve bends towards Phi_max within the data, if all of lambda, alpha and Phi_max are
///    identified, lambda within a factor of three and alpha within a factor of five from the lower to the upper end of its
///    interval, if Phi_max is not at its bound, and if the residuals of a single curve are not systematic;
/// 2. otherwise the line of regime II, to the points of regime II; alpha, Phi_max and the pressure P1* at which regime III
///    begins are those of a power law fitted to the points beyond, where it can be;
/// 3. the power law of regime III, if the curve has no regime II.
///
/// The points before regime II lie on a recompression line, whose slope is kappa; P0*, the yield pressure, is where it
/// meets the line of regime II. The parameters C_c = ln(10) lambda and C_s = ln(10) kappa follow lambda and kappa.
/// Systematic residuals of a single curve widen its intervals.
///
/// A mean over three samples or more is that of samples that may collapse in jumps (collapse_jumps.h): it bends only if its
/// samples do, and the points in which they lag behind the line of regime II are left out of it.
/// @param options  options of fit_consolidation(), of which `law`, `regimes` and `widen` are not used
[[nodiscard]] ConsolidationFit fit_supported_law(const ConsolidationCurve& curve, ConsolidationOptions options);

}  // namespace floc
