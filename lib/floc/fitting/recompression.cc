#include "floc/fitting/recompression.h"

#include "floc/fitting/line_fit.h"

namespace floc {

RecompressionLine recompression_line(const LawPoints& points, bool slopes) {
  const Eigen::ArrayXd w2 = points.weight.array().square();
  RecompressionLine line;
  line.slopes = slopes && points.size() > 1;
  line.centre = (w2 * points.log_P.array()).sum() / w2.sum();
  line.level = (w2 * points.y.array()).sum() / w2.sum();
  if (line.slopes) line.kappa = -fit_weighted_line(points.log_P, points.y, points.weight).slope;
  const Eigen::ArrayXd misfit =
      points.y.array() - line.level + line.kappa * (points.log_P.array() - line.centre);
  line.sum_of_squares = (w2 * misfit.square()).sum();
  return line;
}

}  // namespace floc
