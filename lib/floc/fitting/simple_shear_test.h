#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/fitting/fitted_parameter.h"
#include "floc/fitting/mohr_coulomb.h"

namespace floc {

/// One state of a test in which planes of a sample are sheared along each other: simple shear, ring shear or shear box.
struct PlaneShearPoint {
  double normal_stress = 0.0;      ///< stress across the planes, compression positive
  double shear_stress = 0.0;       ///< stress along the planes that resists the shear
  double shear_strain = 0.0;       ///< displacement along the planes over the height of the sample
  double volumetric_strain = 0.0;  ///< shortening of the height, logarithmic

  PlaneStress stress() const { return {normal_stress, shear_stress}; }
  /// Shear over normal stress, the tangent of the mobilised friction angle without cohesion. Its sign is that of the shear.
  double mobilised() const { return normal_stress > 0.0 ? shear_stress / normal_stress : 0.0; }
};

/// Results that a laboratory reports of one test of simple shear.
struct SimpleShearTest {
  std::string failure_reason;  ///< reason why the test has no strength; empty if it has
  PlaneStress peak_stress;     ///< stresses at the largest mobilised friction
  /// Means over the last part of the test; absent if the test has not come to a critical state.
  std::optional<PlaneStress> critical_stress;
  /// secant_angle_peak, strain_peak, dilatancy_angle and secant_angle_critical
  std::vector<FittedParameter> parameters;
  std::vector<std::string> warnings;

  bool found() const { return failure_reason.empty(); }
};

/// Evaluates one test of simple shear. Friction angles are those of the planes, tan phi = tau/sigma; tan psi of the dilatancy
/// angle psi is minus the slope of the volumetric strain against the shear strain over the points around the peak
/// (volume_at_peak()). The critical state is the last part of the test (critical_part()), with the interval of its
/// fluctuations.
/// @param points         states of the test, the first one before it
/// @param critical_from  shear strain from which on the sample is in its critical state; absent: the last quarter of the
/// strain of the test
[[nodiscard]] SimpleShearTest evaluate_simple_shear_test(const std::vector<PlaneShearPoint>& points,
                                                         const std::optional<double>& critical_from);

}  // namespace floc
