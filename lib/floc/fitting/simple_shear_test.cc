#include "floc/fitting/simple_shear_test.h"

#include <cmath>

#include "floc/fitting/correlated_mean.h"
#include "floc/fitting/student_t.h"
#include "floc/fitting/test_curve.h"

namespace floc {
namespace {

/// Returns the points of a test, with the signs of shear strain and shear stress reversed if the last shear strain is
/// negative.
std::vector<PlaneShearPoint> forwards(std::vector<PlaneShearPoint> points) {
  if (points.empty() || points.back().shear_strain >= 0.0) return points;
  for (PlaneShearPoint& p : points) {
    p.shear_strain = -p.shear_strain;
    p.shear_stress = -p.shear_stress;
  }
  return points;
}

TestCurve curve_of_planes(const std::vector<PlaneShearPoint>& points) {
  TestCurve curve;
  for (const PlaneShearPoint& p : points) {
    curve.strain.push_back(p.shear_strain);
    curve.mobilised.push_back(p.mobilised());
    curve.volumetric.push_back(p.volumetric_strain);
  }
  return curve;
}

FittedParameter dilatancy_tangent(const LinearFit& line) {
  const double tangent = -line.coefficients[1];
  if (line.dof < 1) return held_at("dilatancy_angle", tangent);
  return from_value("dilatancy_angle", tangent, std::sqrt(line.covariance(1, 1)), student_t_95(line.dof));
}

}  // namespace

SimpleShearTest evaluate_simple_shear_test(const std::vector<PlaneShearPoint>& given,
                                           const std::optional<double>& critical_from) {
  SimpleShearTest test;
  const std::vector<PlaneShearPoint> points = forwards(given);
  const TestCurve curve = curve_of_planes(points);
  test.failure_reason = why_no_strength(curve);
  if (!test.found()) return test;
  const std::size_t peak = peak_of(curve);
  test.peak_stress = points[peak].stress();
  test.parameters = {angle_of_tangent(held_at("secant_angle_peak", points[peak].mobilised())),
                     held_at("strain_peak", curve.strain[peak]),
                     angle_of_tangent(dilatancy_tangent(volume_at_peak(curve, peak)))};
  const CriticalPart last = critical_part(curve, critical_from);
  if (!last.why_not.empty()) {
    test.warnings.push_back(last.why_not);
    return test;
  }
  PlaneStress sum;
  for (std::size_t k = last.first; k < points.size(); ++k) {
    sum.normal += points[k].normal_stress;
    sum.shear += points[k].shear_stress;
  }
  const auto n = static_cast<double>(points.size() - last.first);
  test.critical_stress = PlaneStress{sum.normal / n, sum.shear / n};
  const std::vector<double> tangents(curve.mobilised.begin() + static_cast<std::ptrdiff_t>(last.first),
                                     curve.mobilised.end());
  test.parameters.push_back(angle_of_tangent(mean_along_path("secant_angle_critical", tangents)));
  return test;
}

}  // namespace floc
