#include "floc/fitting/least_squares.h"

#include <limits>

namespace floc {

Eigen::MatrixXd unit_covariance(const Eigen::MatrixXd& jacobian) {
  constexpr double kRounding = 1e-13;
  Eigen::VectorXd scale = jacobian.colwise().norm();
  for (double& s : scale)
    if (s == 0.0) s = 1.0;
  const Eigen::MatrixXd scaled = jacobian * scale.cwiseInverse().asDiagonal();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(scaled, Eigen::ComputeThinV);
  const Eigen::VectorXd& sigma = svd.singularValues();
  const Eigen::Index n_seen = (sigma.array() > kRounding * sigma[0]).count();
  const Eigen::MatrixXd half = scale.cwiseInverse().asDiagonal() * svd.matrixV().leftCols(n_seen) *
                               sigma.head(n_seen).cwiseInverse().asDiagonal();
  Eigen::MatrixXd covariance = half * half.transpose();
  const Eigen::VectorXd unseen = svd.matrixV().rightCols(sigma.size() - n_seen).rowwise().squaredNorm();
  for (int k = 0; k < unseen.size(); ++k)
    if (unseen[k] > 1e-6) covariance(k, k) = std::numeric_limits<double>::infinity();
  return covariance;
}

}  // namespace floc
