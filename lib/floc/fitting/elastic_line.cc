#include "floc/fitting/elastic_line.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "floc/fitting/line_fit.h"
#include "floc/fitting/student_t.h"

namespace floc {
namespace {

/// Modulus between neighbouring pressures i and i + 1.
double secant(const Eigen::VectorXd& P, const Eigen::VectorXd& y, Eigen::Index i) {
  return (P[i + 1] - P[i]) / (y[i + 1] - y[i]);
}

/// True if a parabola does better than the line, beyond its error and beyond rounding.
bool is_curved(const Eigen::VectorXd& P, const Eigen::VectorXd& y) {
  if (P.size() < 4) return false;
  const Eigen::ArrayXd x = (P.array() - P.mean()) / (P.maxCoeff() - P.minCoeff());
  Eigen::MatrixXd columns(P.size(), 3);
  columns << Eigen::VectorXd::Ones(P.size()), x.matrix(), x.square().matrix();
  const LinearFit parabola = fit_linear(columns, y);
  const double error = std::sqrt(parabola.covariance(2, 2));
  constexpr double kRounding = 1e-12;
  return std::abs(parabola.coefficients[2]) > std::max(student_t_95(parabola.dof) * error, kRounding);
}

}  // namespace

ElasticFit fit_elastic(const std::vector<double>& P, const std::vector<double>& phi) {
  assert(P.size() == phi.size());
  constexpr int kMinPressures = 3;
  ElasticFit fit;
  const auto n = static_cast<Eigen::Index>(P.size());
  if (n < kMinPressures) {
    fit.refusal = fmt::format("{} pressures on the branch, expected at least {}", n, kMinPressures);
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
  const bool falls = x[0] > x[n - 1];
  fit.secant_low = secant(x, y, falls ? n - 2 : 0);
  fit.secant_high = secant(x, y, falls ? 0 : n - 2);
  if (is_curved(x, y))
    fit.warnings.push_back(
        fmt::format("the branch is curved: the modulus is {:.4g} between its two lowest pressures and "
                    "{:.4g} between its two highest",
                    fit.secant_low, fit.secant_high));
  return fit;
}

}  // namespace floc
