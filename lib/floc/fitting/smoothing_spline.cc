#include "floc/fitting/smoothing_spline.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "floc/base/dense_solvers.h"
#include "floc/base/infinity.h"

namespace floc {
namespace {

/// Matrices Q and R of Reinsch's algorithm. Let f be the values of a spline at x, and g its second derivatives at the
/// inner points. Then R g = Q^T f, and the roughness of the spline (the integral of the squared second derivative) is
/// g^T R g.
struct Bands {
  Eigen::MatrixXd Q, R;
};

Bands bands_of(const Eigen::VectorXd& x) {
  const Eigen::Index n = x.size();
  const Eigen::VectorXd h = x.tail(n - 1) - x.head(n - 1);
  Bands b{Eigen::MatrixXd::Zero(n, n - 2), Eigen::MatrixXd::Zero(n - 2, n - 2)};
  for (Eigen::Index k = 0; k < n - 2; ++k) {
    b.Q(k, k) = 1.0 / h[k];
    b.Q(k + 1, k) = -1.0 / h[k] - 1.0 / h[k + 1];
    b.Q(k + 2, k) = 1.0 / h[k + 1];
    b.R(k, k) = (h[k] + h[k + 1]) / 3.0;
    if (k + 1 < n - 2) b.R(k, k + 1) = b.R(k + 1, k) = h[k + 1] / 6.0;
  }
  return b;
}

}  // namespace

SmoothingSpline::SmoothingSpline(const Eigen::VectorXd& x, const Eigen::VectorXd& y) : x_(x) {
  assert(x.size() == y.size() && x.size() >= 4);
  const Eigen::Index n = x.size();
  const Bands b = bands_of(x);
  // The penalty matrix is K = Q R^-1 Q^T = U diag(s) U^T. The smoother is therefore U diag(1/(1 + mu s)) U^T.
  Eigen::MatrixXd to_second(n - 2, n);
  for (Eigen::Index k = 0; k < n; ++k) to_second.col(k) = solve_symmetric(b.R, b.Q.row(k).transpose());
  const SymmetricEigen penalty = symmetric_eigen(b.Q * to_second);
  const Eigen::ArrayXd s = penalty.values.array().max(0.0);
  const Eigen::ArrayXd parts = penalty.vectors.transpose() * y;
  const double largest = s.maxCoeff();
  // the first two eigenvalues are 0: they belong to straight lines
  const double smallest = *std::min_element(s.begin() + 2, s.end());
  double best = kInfinity, mu = 0.0;
  constexpr int kTried = 80;
  // Factor of the degrees of freedom. Without this factor, generalised cross-validation sometimes chooses a spline that
  // follows the noise, especially if the noise is correlated.
  constexpr double kCaution = 1.4;
  const double low = std::log(1e-3 / largest), high = std::log(1e3 / smallest);
  for (int k = 0; k <= kTried; ++k) {
    const double tried = std::exp(low + (high - low) * k / kTried);
    const Eigen::ArrayXd shrunk = (1.0 + tried * s).inverse();
    const double left = ((1.0 - shrunk) * parts).square().sum();
    const double free = static_cast<double>(n) - kCaution * shrunk.sum();
    if (free <= 0.0) continue;
    const double score = left / (free * free);
    if (score < best) best = score, mu = tried;
  }
  smoother_ = penalty.vectors * (1.0 + mu * s).inverse().matrix().asDiagonal() * penalty.vectors.transpose();
  second_ = Eigen::MatrixXd::Zero(n, n);
  second_.middleRows(1, n - 2) = to_second * smoother_;
}

SmoothingSpline::Operators SmoothingSpline::operators(const Eigen::VectorXd& at) const {
  const Eigen::Index n = x_.size();
  Operators o{Eigen::MatrixXd(at.size(), n), Eigen::MatrixXd(at.size(), n), Eigen::MatrixXd(at.size(), n)};
  for (Eigen::Index i = 0; i < at.size(); ++i) {
    const Eigen::Index k =
        std::clamp<Eigen::Index>(std::upper_bound(x_.begin(), x_.end(), at[i]) - x_.begin() - 1, 0, n - 2);
    const double h = x_[k + 1] - x_[k], b = (at[i] - x_[k]) / h, a = 1.0 - b;
    const auto f0 = smoother_.row(k), f1 = smoother_.row(k + 1);
    const auto g0 = second_.row(k), g1 = second_.row(k + 1);
    o.value.row(i) = a * f0 + b * f1 + ((a * a * a - a) * g0 + (b * b * b - b) * g1) * (h * h / 6.0);
    o.slope.row(i) = (f1 - f0) / h + ((1.0 - 3.0 * a * a) * g0 + (3.0 * b * b - 1.0) * g1) * (h / 6.0);
    o.curvature.row(i) = a * g0 + b * g1;
  }
  return o;
}

}  // namespace floc
