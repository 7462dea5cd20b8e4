#include "floc/linalg/condition.h"

#include <cmath>

namespace floc {

double inverse_norm_estimate(Eigen::Index n,
                             const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& apply_inverse) {
  constexpr int kMaxSteps = 5;  // more steps of Hager's method do not improve the estimate (Higham)
  Eigen::VectorXd x = Eigen::VectorXd::Constant(n, 1.0 / static_cast<double>(n));
  double norm = 0.0;
  for (int step = 0; step < kMaxSteps; ++step) {
    const Eigen::VectorXd y = apply_inverse(x);
    const double estimate = y.lpNorm<1>();
    if (!(estimate > norm)) break;
    norm = estimate;
    const Eigen::VectorXd z = apply_inverse(y.unaryExpr([](double v) { return v < 0.0 ? -1.0 : 1.0; }));
    Eigen::Index at = 0;
    if (!(z.cwiseAbs().maxCoeff(&at) > std::abs(z.dot(x)))) break;
    x = Eigen::VectorXd::Unit(n, at);
  }
  return norm;
}

}  // namespace floc
