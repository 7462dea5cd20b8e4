#include "floc/fitting/shear_test.h"

#include <algorithm>
#include <cmath>

#include "floc/fitting/correlated_mean.h"
#include "floc/fitting/student_t.h"
#include "floc/fitting/test_curve.h"

namespace floc {
namespace {

using TestPoints = std::vector<ShearPoint>;

/// Returns 1 if the sample shortens along the axis, and -1 if it lengthens.
double direction_of(const TestPoints& points) {
  return !points.empty() && points.back().axial_strain < 0.0 ? -1.0 : 1.0;
}

/// Returns the deviator sigma_1 - sigma_3 that resists a strain in the given direction. It is negative at the beginning
/// of a reversed strain.
double deviator(const ShearPoint& p, double direction) {
  return direction * (p.axial_stress - p.lateral_stress);
}

/// Returns the mobilised friction and the volumetric strain of a test against the magnitude of its axial strain.
TestCurve curve_of(const TestPoints& points) {
  TestCurve curve;
  const double direction = direction_of(points);
  for (const ShearPoint& p : points) {
    curve.strain.push_back(direction * p.axial_strain);
    curve.mobilised.push_back(deviator(p, direction) < 0.0 ? -p.mobilised() : p.mobilised());
    curve.volumetric.push_back(p.volumetric_strain);
  }
  return curve;
}

/// Returns the sine of the dilatancy angle psi at the peak. Let s be the slope of the volumetric strain against the
/// magnitude of the axial strain, at the points around the peak. For the plastic potential of Mohr and Coulomb, sin psi
/// is -s/(2 - s) if the sample shortens along the axis, and -s/(2 + s) if it lengthens, both in 2D and in 3D.
FittedParameter dilatancy_sine(const LinearFit& line, bool shortens) {
  const double slope = line.coefficients[1];
  const double shear = shortens ? 2.0 - slope : 2.0 + slope;
  if (line.dof < 1) return held_at("", -slope / shear);
  // The derivative of sin psi with respect to s is -2/shear^2, where `shear` is 2 - s or 2 + s.
  const double error = std::sqrt(line.covariance(1, 1)) * 2.0 / (shear * shear);
  return from_value("", -slope / shear, error, student_t_95(line.dof));
}

FittedParameter named(const char* name, FittedParameter p) {
  p.name = name;
  return p;
}

/// Adds the parameters of the critical state, which consists of the points from `first` on.
void add_critical(const TestPoints& points, std::size_t first, bool undrained, ShearTest& test) {
  std::vector<double> sines, strengths;
  FailureStress sum;
  for (std::size_t k = first; k < points.size(); ++k) {
    sines.push_back(points[k].mobilised());
    strengths.push_back(0.5 * deviator(points[k], direction_of(points)));
    sum.major += points[k].failure().major;
    sum.minor += points[k].failure().minor;
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
  const TestCurve curve = curve_of(points);
  test.failure_reason = why_no_strength(curve);
  if (!test.found()) return test;
  const std::size_t peak = peak_of(curve);
  test.peak = static_cast<int>(peak);
  test.peak_stress = points[peak].failure();
  test.parameters = {held_at("secant_angle_peak", secant_angle(test.peak_stress)),
                     held_at("strain_peak", curve.strain[peak])};
  if (options.undrained) {
    const double direction = direction_of(points);
    const double rise = deviator(points[peak], direction) - deviator(points.front(), direction);
    // In an undrained test the mean stress changes, so that the deviator may be largest at another point than the
    // mobilised friction. The undrained strength is half of the largest deviator, and not half of the deviator at the
    // peak of the mobilised friction.
    const auto strongest = std::max_element(
        points.begin(), points.end(),
        [direction](const auto& a, const auto& b) { return deviator(a, direction) < deviator(b, direction); });
    test.parameters.push_back(held_at("undrained_strength_peak", 0.5 * deviator(*strongest, direction)));
    // The pore pressure coefficient is A = (sigma_3 at the start - sigma_3 at the peak) divided by the rise of the
    // deviator. A rise of zero or less would give a number without meaning.
    if (rise > 0.0)
      test.parameters.push_back(held_at("pore_pressure_coefficient",
                                        (points.front().failure().minor - test.peak_stress.minor) / rise));
  } else {
    // The volume is constant in an undrained test, so that only a drained test has an angle of dilatancy.
    const FittedParameter sine = dilatancy_sine(volume_at_peak(curve, peak), points.back().axial_strain > 0.0);
    test.parameters.push_back(named("dilatancy_angle", angle_of_sine(sine)));
  }
  const CriticalPart last = critical_part(curve, options.critical_from);
  if (last.why_not.empty())
    add_critical(points, last.first, options.undrained, test);
  else
    test.warnings.push_back(last.why_not);
  return test;
}

}  // namespace floc
