#pragma once

#include "floc/fitting/consolidation.h"
#include "floc/fitting/law_estimate.h"

namespace floc {

/// Window of points to which a consolidation law is fitted: index of the first point `first`, number of points `n`,
/// number of points of the plateau or recompression line before the window, and number of points between this line and
/// the window, which are left out of the fit.
struct Window {
  int first, n;
  int n_plateau;
  int n_left_out = 0;

  int first_of_plateau() const { return first - n_left_out - n_plateau; }
};

/// Finds the pattern in the residuals of a fit to a single curve, and warns if they are systematic.
void check_residuals(const LawEstimate& estimate, ConsolidationFit& fit);

/// Warns if a level line is fitted to the plateau of regime I although the plateau has a slope, as in the recompression
/// of a soil. In this case, P0* is the pressure at which the line of regime II meets the mean level of the plateau. For
/// comparison, the warning gives the pressure at which the line of regime II meets a sloping line through the plateau.
void check_plateau(const LawEstimate& estimate, ConsolidationFit& fit);

/// Moves one end of the range of fitted points by one point, and fits the law again. Does this for both ends and both
/// directions. Warns if lambda, the slope of regime II, changes by more than its standard error.
/// @param all  all points of the curve
void shift_window(const LawEstimate& estimate, const LawPoints& all, const Window& window,
                  ConsolidationFit& fit);

}  // namespace floc
