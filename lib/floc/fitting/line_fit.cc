#include "floc/fitting/line_fit.h"

#include <Eigen/Dense>
#include <cassert>

namespace floc {

LinearFit fit_linear(const Eigen::MatrixXd& columns, const Eigen::VectorXd& y) {
  assert(columns.rows() == y.size() && columns.rows() >= columns.cols());
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(columns);
  LinearFit fit;
  fit.coefficients = qr.solve(y);
  fit.sum_of_squares = (y - columns * fit.coefficients).squaredNorm();
  fit.dof = static_cast<int>(columns.rows() - columns.cols());
  const Eigen::Index n = columns.cols();
  const Eigen::MatrixXd upper = qr.matrixQR().topRows(n).triangularView<Eigen::Upper>();
  const Eigen::MatrixXd inverse = upper.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(n, n));
  const double variance = fit.dof > 0 ? fit.sum_of_squares / fit.dof : 0.0;
  fit.covariance = variance * inverse * inverse.transpose();
  return fit;
}

}  // namespace floc
