#include "floc/fitting/line_fit.h"

#include <cassert>

#include "floc/base/dense_solvers.h"

namespace floc {

LinearFit fit_linear(const Eigen::MatrixXd& columns, const Eigen::VectorXd& y) {
  assert(columns.rows() == y.size() && columns.rows() >= columns.cols());
  const LinearSystemByQr qr = solve_by_qr(columns, y);
  LinearFit fit;
  fit.coefficients = qr.solution;
  fit.sum_of_squares = (y - columns * fit.coefficients).squaredNorm();
  fit.dof = static_cast<int>(columns.rows() - columns.cols());
  const double variance = fit.dof > 0 ? fit.sum_of_squares / fit.dof : 0.0;
  fit.covariance = variance * qr.inverse_of_r * qr.inverse_of_r.transpose();
  return fit;
}

WeightedLine fit_weighted_line(const Eigen::VectorXd& x, const Eigen::VectorXd& y,
                               const Eigen::VectorXd& weight) {
  const Eigen::ArrayXd w2 = weight.array().square();
  const double mean_x = (w2 * x.array()).sum() / w2.sum();
  const double mean_y = (w2 * y.array()).sum() / w2.sum();
  const Eigen::ArrayXd dx = x.array() - mean_x;
  const Eigen::ArrayXd dy = y.array() - mean_y;
  const double sxx = (w2 * dx.square()).sum();
  const double slope = sxx == 0.0 ? 0.0 : (w2 * dx * dy).sum() / sxx;
  return {mean_y - slope * mean_x, slope, (w2 * (dy - slope * dx).square()).sum()};
}

}  // namespace floc
