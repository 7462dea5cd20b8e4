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

}  // namespace floc
