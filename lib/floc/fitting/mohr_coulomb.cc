#include "floc/fitting/mohr_coulomb.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "floc/fitting/line_fit.h"
#include "floc/fitting/student_t.h"

namespace floc {
namespace {

double degrees(double radians) {
  return radians * 180.0 / std::numbers::pi;
}

/// Returns the friction angle phi (degrees) for which (1 + sin phi)/(1 - sin phi) is N.
double angle_of_ratio(double N) {
  return degrees(std::asin((N - 1.0) / (N + 1.0)));
}

/// Fits the line y = C + N x by least squares of relative residuals; the coefficients of the result are C and N. Each
/// residual is divided by the fitted y. The fit is repeated in a few rounds, because the fitted y is not known at
/// first; the first round uses the measured y.
LinearFit line_of_relative_errors(const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
  constexpr int kRounds = 4;
  Eigen::VectorXd scale = y;
  LinearFit line;
  for (int round = 0; round < kRounds; ++round) {
    Eigen::MatrixXd columns(x.size(), 2);
    columns << scale.cwiseInverse(), x.cwiseQuotient(scale);
    line = fit_linear(columns, y.cwiseQuotient(scale));
    const Eigen::VectorXd fitted = line.coefficients[0] + (line.coefficients[1] * x).array();
    if ((fitted.array() <= 0.0).any()) break;
    scale = fitted;
  }
  return line;
}

/// For each sample, the imposed stress and the stress at which the sample fails.
struct Failures {
  Eigen::VectorXd imposed, found;
  const char *name, *name_of_found;  ///< names of both stresses in messages
};

template <class Stress>
Failures failures_of(const std::vector<Stress>& stresses, double Stress::*imposed, double Stress::*found,
                     const char* name, const char* name_of_found) {
  const auto n = static_cast<Eigen::Index>(stresses.size());
  Failures failures{Eigen::VectorXd(n), Eigen::VectorXd(n), name, name_of_found};
  for (Eigen::Index i = 0; i < n; ++i) {
    failures.imposed[i] = stresses[static_cast<std::size_t>(i)].*imposed;
    failures.found[i] = stresses[static_cast<std::size_t>(i)].*found;
  }
  return failures;
}

/// Returns the reason why no line can be fitted to the samples; empty if a line can be fitted.
std::string why_no_line(const Failures& f) {
  constexpr Eigen::Index kLeast = 3;
  if (f.imposed.size() < kLeast)
    return fmt::format("there are {} tests, but a line with its error needs at least {}", f.imposed.size(),
                       kLeast);
  if (const double weakest = f.found.minCoeff(); !(weakest > 0.0))
    return fmt::format(
        "a test failed at the {} stress {:.6g}, but a line of relative errors needs stresses above zero",
        f.name_of_found, weakest);
  // If the imposed stresses are nearly equal, the tests do not determine the slope.
  constexpr double kLeastRange = 0.05;
  const double least = f.imposed.minCoeff(), most = f.imposed.maxCoeff();
  if (most - least >= kLeastRange * most) return "";
  return fmt::format(
      "the {} stresses of the tests, {:.6g} to {:.6g}, differ by less than 5 %, so that friction angle and "
      "cohesion cannot be separated",
      f.name, least, most);
}

void warn_of_negative_cohesion(MohrCoulombFit& fit) {
  if (*fit.cohesion.high95 >= 0.0) return;
  fit.warnings.push_back(
      fmt::format("the cohesion of the line is negative, {:.5g} (95 % interval {:.5g} to {:.5g}): the envelope "
                  "of the tests is curved, and the fitted angle is valid only in their range of stresses",
                  *fit.cohesion.value, *fit.cohesion.low95, *fit.cohesion.high95));
}

MohrCoulombFit refused_line(std::string why) {
  MohrCoulombFit fit;
  fit.failure_reason = std::move(why);
  return fit;
}

}  // namespace

MohrCoulombFit fit_mohr_coulomb(const std::vector<FailureStress>& stresses, const std::string& suffix) {
  const Failures failures =
      failures_of(stresses, &FailureStress::minor, &FailureStress::major, "lateral", "largest");
  if (std::string why = why_no_line(failures); !why.empty()) return refused_line(std::move(why));
  const LinearFit line = line_of_relative_errors(failures.imposed, failures.found);
  const double C = line.coefficients[0], N = line.coefficients[1];
  if (!(N > 1.0))
    return refused_line(
        fmt::format("the largest stress grows by only {:.4g} for each unit of the lateral stress, so "
                    "that the line has no friction angle",
                    N));
  MohrCoulombFit fit;
  fit.rms = std::sqrt(line.sum_of_squares / static_cast<double>(stresses.size()));
  const double t95 = student_t_95(line.dof), error = std::sqrt(line.covariance(1, 1));
  const FittedParameter ratio = from_logarithm("N", std::log(N), error / N, t95);
  // The derivative of the friction angle phi with respect to ln N is cos(phi)/2.
  const double phi = std::asin((N - 1.0) / (N + 1.0));
  fit.angle = {"friction_angle" + suffix,
               degrees(phi),
               degrees(0.5 * std::cos(phi) * error / N),
               angle_of_ratio(*ratio.low95),
               angle_of_ratio(*ratio.high95),
               *ratio.low95 > 1.0};
  // For the line sigma_1 = C + N sigma_3, the cohesion is C/(2 sqrt N). Its error follows from the covariance of C and
  // N by error propagation.
  const double by_C = 0.5 / std::sqrt(N), by_N = -0.25 * C / (N * std::sqrt(N));
  const double variance = by_C * by_C * line.covariance(0, 0) + 2.0 * by_C * by_N * line.covariance(0, 1) +
                          by_N * by_N * line.covariance(1, 1);
  fit.cohesion = from_value("cohesion" + suffix, C * by_C, std::sqrt(std::max(0.0, variance)), t95);
  warn_of_negative_cohesion(fit);
  return fit;
}

MohrCoulombFit fit_mohr_coulomb_planes(const std::vector<PlaneStress>& stresses, const std::string& suffix) {
  const Failures failures = failures_of(stresses, &PlaneStress::normal, &PlaneStress::shear, "normal", "shear");
  if (std::string why = why_no_line(failures); !why.empty()) return refused_line(std::move(why));
  const LinearFit line = line_of_relative_errors(failures.imposed, failures.found);
  if (!(line.coefficients[1] > 0.0))
    return refused_line(
        fmt::format("the shear stress changes by {:.4g} for each unit of the normal stress, so that the "
                    "line has no friction angle",
                    line.coefficients[1]));
  MohrCoulombFit fit;
  fit.rms = std::sqrt(line.sum_of_squares / static_cast<double>(stresses.size()));
  const double t95 = student_t_95(line.dof);
  const auto coefficient = [&](const std::string& name, int k) {
    return from_value(name, line.coefficients[k], std::sqrt(line.covariance(k, k)), t95);
  };
  fit.angle = angle_of_tangent(coefficient("friction_angle" + suffix, 1));
  fit.cohesion = coefficient("cohesion" + suffix, 0);
  warn_of_negative_cohesion(fit);
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

FittedParameter angle_of_tangent(const FittedParameter& tangent) {
  FittedParameter p = tangent;
  if (p.value && p.standard_error) p.standard_error = degrees(*p.standard_error / (1.0 + *p.value * *p.value));
  for (auto* end : {&p.value, &p.low95, &p.high95})
    if (*end) *end = degrees(std::atan(**end));
  return p;
}

}  // namespace floc
