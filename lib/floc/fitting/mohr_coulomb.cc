#include "floc/fitting/mohr_coulomb.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "floc/fitting/line_fit.h"
#include "floc/fitting/student_t.h"

namespace floc {
namespace {

double degrees(double radians) {
  return radians * 180.0 / std::numbers::pi;
}

/// Returns the friction angle phi of N = (1 + sin phi)/(1 - sin phi) (degrees).
double angle_of_ratio(double N) {
  return degrees(std::asin((N - 1.0) / (N + 1.0)));
}

/// Returns the line sigma_1 = C + N sigma_3 with the coefficients C and N. Residuals are relative to the fitted
/// sigma_1; the weights converge in two or three rounds.
LinearFit line_of_relative_errors(const Eigen::VectorXd& minor, const Eigen::VectorXd& major) {
  constexpr int kRounds = 4;
  Eigen::VectorXd scale = major;
  LinearFit line;
  for (int round = 0; round < kRounds; ++round) {
    Eigen::MatrixXd columns(minor.size(), 2);
    columns << scale.cwiseInverse(), minor.cwiseQuotient(scale);
    line = fit_linear(columns, major.cwiseQuotient(scale));
    const Eigen::VectorXd fitted = line.coefficients[0] + (line.coefficients[1] * minor).array();
    if ((fitted.array() <= 0.0).any()) break;
    scale = fitted;
  }
  return line;
}

}  // namespace

MohrCoulombFit fit_mohr_coulomb(const std::vector<FailureStress>& stresses, const std::string& suffix) {
  MohrCoulombFit fit;
  constexpr std::size_t kLeast = 3;
  if (stresses.size() < kLeast) {
    fit.failure_reason =
        fmt::format("there are {} tests, but a line with its error needs at least {}", stresses.size(), kLeast);
    return fit;
  }
  const auto n = static_cast<Eigen::Index>(stresses.size());
  Eigen::VectorXd minor(n), major(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    minor[i] = stresses[static_cast<std::size_t>(i)].minor;
    major[i] = stresses[static_cast<std::size_t>(i)].major;
  }
  // Tests at nearly equal lateral stresses do not determine the slope.
  constexpr double kLeastRange = 0.05;
  if (!(major.minCoeff() > 0.0) || minor.maxCoeff() - minor.minCoeff() < kLeastRange * minor.maxCoeff()) {
    fit.failure_reason = fmt::format(
        "the lateral stresses of the tests, {:.6g} to {:.6g}, differ by less than 5 %, so that friction "
        "angle and cohesion cannot be separated",
        minor.minCoeff(), minor.maxCoeff());
    return fit;
  }
  const LinearFit line = line_of_relative_errors(minor, major);
  const double C = line.coefficients[0], N = line.coefficients[1];
  if (!(N > 1.0)) {
    fit.failure_reason = fmt::format(
        "the largest stress grows by only {:.4g} for each unit of the lateral stress, so "
        "that the line has no friction angle",
        N);
    return fit;
  }
  fit.rms = std::sqrt(line.sum_of_squares / static_cast<double>(n));
  const double t95 = student_t_95(line.dof), error = std::sqrt(line.covariance(1, 1));
  const FittedParameter ratio = from_logarithm("N", std::log(N), error / N, t95);
  // d phi/d ln N = cos(phi)/2.
  const double phi = std::asin((N - 1.0) / (N + 1.0));
  fit.angle = {"friction_angle" + suffix,
               degrees(phi),
               degrees(0.5 * std::cos(phi) * error / N),
               angle_of_ratio(*ratio.low95),
               angle_of_ratio(*ratio.high95),
               *ratio.low95 > 1.0};
  // The cohesion is c = C/(2 sqrt N), for the line sigma_1 = C + N sigma_3. Its error follows by propagation of
  // the errors of C and N.
  const double by_C = 0.5 / std::sqrt(N), by_N = -0.25 * C / (N * std::sqrt(N));
  const double variance = by_C * by_C * line.covariance(0, 0) + 2.0 * by_C * by_N * line.covariance(0, 1) +
                          by_N * by_N * line.covariance(1, 1);
  fit.cohesion = from_value("cohesion" + suffix, C * by_C, std::sqrt(std::max(0.0, variance)), t95);
  if (*fit.cohesion.high95 < 0.0)
    fit.warnings.push_back(fmt::format(
        "the cohesion of the line is negative, {:.5g} (95 % interval {:.5g} to {:.5g}): the envelope of the "
        "tests is curved, and its angle belongs to their range of stresses alone",
        *fit.cohesion.value, *fit.cohesion.low95, *fit.cohesion.high95));
  return fit;
}

double secant_angle(const FailureStress& s) {
  return degrees(std::asin((s.major - s.minor) / (s.major + s.minor)));
}

FittedParameter angle_of_sine(const FittedParameter& sine) {
  const auto angle = [](double x) { return degrees(std::asin(std::clamp(x, -1.0, 1.0))); };
  FittedParameter p = sine;
  // An interval of the sine that extends beyond -1 or 1 does not determine the angle.
  if (p.low95 && p.high95) p.identified = p.identified && *p.low95 > -1.0 && *p.high95 < 1.0;
  if (p.value && p.standard_error)
    p.standard_error = degrees(*p.standard_error / std::sqrt(std::max(1e-12, 1.0 - *p.value * *p.value)));
  for (auto* end : {&p.value, &p.low95, &p.high95})
    if (*end) *end = angle(**end);
  return p;
}

}  // namespace floc
