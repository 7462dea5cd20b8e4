#include "floc/fitting/shear_test.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "floc/fitting/correlated_mean.h"
#include "floc/fitting/line_fit.h"
#include "floc/fitting/student_t.h"

namespace floc {
namespace {

using TestPoints = std::vector<ShearPoint>;

double deviator(const ShearPoint& p) {
  return p.failure().major - p.failure().minor;
}

/// Returns the axial strain of a point. It is positive in the direction in which the test deforms the sample.
double progress(const TestPoints& points, std::size_t k) {
  return points.back().axial_strain < 0.0 ? -points[k].axial_strain : points[k].axial_strain;
}

/// Returns the sine of the dilatancy angle psi at the peak. It follows from the slope s of the volumetric
/// strain against the magnitude of the axial strain, at the points around the peak. For the plastic potential
/// of Mohr and Coulomb, sin psi is -s/(2 - s) if the sample shortens along the axis, and -s/(2 + s) if it
/// lengthens, both in 2D and in 3D.
FittedParameter dilatancy_sine(const TestPoints& points, std::size_t peak) {
  constexpr double kNear = 0.95;
  std::size_t first = peak, last = peak;
  const double enough = kNear * points[peak].mobilised();
  while (first > 0 && points[first - 1].mobilised() >= enough) --first;
  while (last + 1 < points.size() && points[last + 1].mobilised() >= enough) ++last;
  // The standard error of a slope needs several points.
  constexpr std::size_t kLeast = 5;
  while (last - first + 1 < std::min(kLeast, points.size())) {
    if (first > 0) --first;
    if (last + 1 < points.size()) ++last;
  }
  const auto n = static_cast<Eigen::Index>(last - first + 1);
  Eigen::MatrixXd columns = Eigen::MatrixXd::Ones(n, 2);
  Eigen::VectorXd volumetric(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    columns(i, 1) = progress(points, first + static_cast<std::size_t>(i));
    volumetric[i] = points[first + static_cast<std::size_t>(i)].volumetric_strain;
  }
  const LinearFit line = fit_linear(columns, volumetric);
  const double slope = line.coefficients[1];
  const double shear = points.back().axial_strain > 0.0 ? 2.0 - slope : 2.0 + slope;
  if (line.dof < 1) return held_at("", -slope / shear);
  // The derivative of sin psi with respect to s is -2/shear^2.
  const double error = std::sqrt(line.covariance(1, 1)) * 2.0 / (shear * shear);
  return from_value("", -slope / shear, error, student_t_95(line.dof));
}

FittedParameter named(const char* name, FittedParameter p) {
  p.name = name;
  return p;
}

/// Adds the parameters of the critical state, from the last part of the test, or a warning with the reason why
/// there are none.
/// @param first  index of the first point of this part
void add_critical(const TestPoints& points, std::size_t first, bool undrained, ShearTest& test) {
  std::vector<double> sines, strengths;
  FailureStress sum;
  for (std::size_t k = first; k < points.size(); ++k) {
    sines.push_back(points[k].mobilised());
    strengths.push_back(0.5 * deviator(points[k]));
    sum.major += points[k].failure().major;
    sum.minor += points[k].failure().minor;
  }
  constexpr double kSteady = 0.1;
  const double strain = progress(points, points.size() - 1) - progress(points, first);
  const double volume = points.back().volumetric_strain - points[first].volumetric_strain;
  if (sines.size() < 3 || !(strain > 0.0) || std::abs(volume) > kSteady * strain) {
    test.warnings.push_back(
        sines.size() < 3
            ? fmt::format(
                  "the last part of the test, from an axial strain of {:.4g} on, has {} states: expected at "
                  "least 3 for a critical state",
                  progress(points, first), sines.size())
            : fmt::format(
                  "the test has not come to a critical state: from an axial strain of {:.4g} on the volumetric "
                  "strain still changes by {:.3g}, {:.2g} of the axial strain; expected at most {}",
                  progress(points, first), volume, std::abs(volume) / strain, kSteady));
    return;
  }
  const auto n = static_cast<double>(sines.size());
  test.critical_stress = FailureStress{sum.major / n, sum.minor / n};
  test.parameters.push_back(named("secant_angle_critical", angle_of_sine(mean_along_path("", sines))));
  if (undrained) test.parameters.push_back(mean_along_path("undrained_strength_critical", strengths));
}

}  // namespace

FailureStress ShearPoint::failure() const {
  return {std::max(axial_stress, lateral_stress), std::min(axial_stress, lateral_stress)};
}

double ShearPoint::mobilised() const {
  const FailureStress f = failure();
  return f.major + f.minor > 0.0 ? (f.major - f.minor) / (f.major + f.minor) : 0.0;
}

ShearTest evaluate_shear_test(const TestPoints& points, const ShearTestOptions& options) {
  ShearTest test;
  constexpr std::size_t kLeast = 4;
  if (points.size() < kLeast || points.back().axial_strain == 0.0) {
    test.failure_reason = fmt::format("it has {} states: expected at least {}, with a growing axial strain",
                                      points.size(), kLeast);
    return test;
  }
  const auto less = [](const ShearPoint& a, const ShearPoint& b) { return a.mobilised() < b.mobilised(); };
  const auto peak =
      static_cast<std::size_t>(std::max_element(points.begin(), points.end(), less) - points.begin());
  test.peak = static_cast<int>(peak);
  test.peak_stress = points[peak].failure();
  test.parameters = {held_at("secant_angle_peak", secant_angle(test.peak_stress)),
                     held_at("strain_peak", progress(points, peak))};
  if (options.undrained) {
    const double rise = deviator(points[peak]) - deviator(points.front());
    const auto strongest = std::max_element(
        points.begin(), points.end(), [](const auto& a, const auto& b) { return deviator(a) < deviator(b); });
    test.parameters.push_back(held_at("undrained_strength_peak", 0.5 * deviator(*strongest)));
    if (rise > 0.0)
      test.parameters.push_back(held_at("pore_pressure_coefficient",
                                        (points.front().failure().minor - test.peak_stress.minor) / rise));
  } else {
    test.parameters.push_back(named("dilatancy_angle", angle_of_sine(dilatancy_sine(points, peak))));
  }
  constexpr double kLastPart = 0.75;
  const double from = options.critical_from.value_or(kLastPart * progress(points, points.size() - 1));
  std::size_t first = 0;
  while (first + 1 < points.size() && progress(points, first) < from) ++first;
  add_critical(points, first, options.undrained, test);
  return test;
}

}  // namespace floc
