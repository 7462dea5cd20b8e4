#include "floc/fitting/elastic_line.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "floc/fitting/line_fit.h"
#include "floc/fitting/student_t.h"

namespace floc {
namespace {

/// Tangent moduli at both ends of the branch from a parabola, and a warning if it does better than the line.
void look_for_curvature(const Eigen::VectorXd& P, const Eigen::VectorXd& y, ElasticFit& fit) {
  fit.tangent_low = fit.tangent_high = std::numeric_limits<double>::quiet_NaN();
  if (P.size() < 4) return;
  const double middle = P.mean();
  const double range = P.maxCoeff() - P.minCoeff();
  const Eigen::ArrayXd x = (P.array() - middle) / range;
  Eigen::MatrixXd columns(P.size(), 3);
  columns << Eigen::VectorXd::Ones(P.size()), x.matrix(), x.square().matrix();
  const LinearFit parabola = fit_linear(columns, y);
  const auto tangent = [&](double at) {
    return range / (parabola.coefficients[1] + 2 * parabola.coefficients[2] * (at - middle) / range);
  };
  fit.tangent_low = tangent(P.minCoeff());
  fit.tangent_high = tangent(P.maxCoeff());
  const double error = std::sqrt(parabola.covariance(2, 2));
  const double rounding = 1e-12 * std::abs(parabola.coefficients[1]);
  if (std::abs(parabola.coefficients[2]) > std::max(student_t_95(parabola.dof) * error, rounding))
    fit.warnings.push_back(
        fmt::format("the branch is curved: the tangent modulus goes from {:.4g} at its lowest pressure to "
                    "{:.4g} at its highest",
                    fit.tangent_low, fit.tangent_high));
}

}  // namespace

ElasticFit fit_elastic(const std::vector<double>& P, const std::vector<double>& phi) {
  assert(P.size() == phi.size());
  constexpr int kFewest = 3;
  ElasticFit fit;
  const auto n = static_cast<Eigen::Index>(P.size());
  if (n < kFewest) {
    fit.refusal = fmt::format("{} pressures on the branch, expected at least {}", n, kFewest);
    return fit;
  }
  const Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(P.data(), n);
  const Eigen::VectorXd y = Eigen::Map<const Eigen::ArrayXd>(phi.data(), n).log();
  Eigen::MatrixXd columns(n, 2);
  columns << Eigen::VectorXd::Ones(n), x;
  const LinearFit line = fit_linear(columns, y);
  if (line.coefficients[1] <= 0.0) {
    fit.refusal = "the solid fraction does not fall as the pressure falls: no elastic branch";
    return fit;
  }
  const double t95 = student_t_95(line.dof);
  fit.parameters = {
      from_inverse("B", line.coefficients[1], std::sqrt(line.covariance(1, 1)), t95),
      from_logarithm("phi_unloaded", line.coefficients[0], std::sqrt(line.covariance(0, 0)), t95)};
  fit.rms = std::sqrt(line.sum_of_squares / static_cast<double>(n));
  look_for_curvature(x, y, fit);
  return fit;
}

}  // namespace floc
