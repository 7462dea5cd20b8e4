#pragma once

#include "floc/fitting/consolidation_solver.h"

namespace floc {

/// Straight line through the points before regime II: the recompression line of a soil or, with kappa = 0, the plateau
/// of regime I. Along the line, 1/Phi falls by kappa per unit of ln P*.
struct RecompressionLine {
  bool slopes = false;  ///< whether kappa was fitted; otherwise it is 0
  double centre = 0.0;  ///< weighted mean of ln P* over the points
  double level = 0.0;   ///< 1/Phi of the line at `centre`; equal to the weighted mean of 1/Phi over the points
  double kappa = 0.0;   ///< slope -d(1/Phi)/d(ln P*)
  double sum_of_squares = 0.0;  ///< sum of squares of the weighted residuals

  /// Returns 1/Phi on the line at the reduced pressure exp(log_P).
  double at(double log_P) const { return level - kappa * (log_P - centre); }
};

/// Fits a recompression line by weighted least squares.
/// @param slopes  whether to fit the slope, for which two points or more are needed; otherwise the line is level
/// @return the line; all NaN if there are no points
RecompressionLine recompression_line(const LawPoints& points, bool slopes);

}  // namespace floc
