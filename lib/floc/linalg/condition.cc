#include "floc/linalg/condition.h"

#include <cmath>

#include "floc/base/random.h"

namespace floc {
namespace {

/// Continues Hager's method from the vector `x` of 1-norm 1 as long as its estimate grows.
/// @param norm  estimate reached before, or zero; receives the larger estimate
void continue_estimate(Eigen::VectorXd x,
                       const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& apply_inverse,
                       double& norm) {
  constexpr int kMaxSteps = 5;  // more steps of Hager's method do not improve the estimate (Higham)
  for (int step = 0; step < kMaxSteps; ++step) {
    const Eigen::VectorXd y = apply_inverse(x);
    const double estimate = y.lpNorm<1>();
    if (!(estimate > norm)) break;
    norm = estimate;
    const Eigen::VectorXd z = apply_inverse(y.unaryExpr([](double v) { return v < 0.0 ? -1.0 : 1.0; }));
    Eigen::Index at = 0;
    if (!(z.cwiseAbs().maxCoeff(&at) > std::abs(z.dot(x)))) break;
    x = Eigen::VectorXd::Unit(z.size(), at);
  }
}

/// Returns a vector of 1-norm 1 with random components, always the same for one order n.
Eigen::VectorXd random_start(Eigen::Index n) {
  RandomStream random(1, 1);
  Eigen::VectorXd x(n);
  for (double& component : x) component = random.uniform(-1.0, 1.0);
  return x / x.lpNorm<1>();
}

}  // namespace

double inverse_norm_estimate(Eigen::Index n,
                             const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& apply_inverse) {
  double norm = 0.0;
  continue_estimate(Eigen::VectorXd::Constant(n, 1.0 / static_cast<double>(n)), apply_inverse, norm);
  // The constant vector is orthogonal to the softest motions of regular packings, for example to grains that turn in
  // opposite directions like gears, and the estimate would miss them.
  continue_estimate(random_start(n), apply_inverse, norm);
  return norm;
}

}  // namespace floc
