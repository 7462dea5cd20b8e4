#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/fitting/fitted_parameter.h"
#include "floc/fitting/mohr_coulomb.h"

namespace floc {

/// One state of a test in which parallel planes of a sample slide along each other: simple shear, ring shear or shear
/// box.
struct PlaneShearPoint {
  double normal_stress = 0.0;      ///< normal stress on the planes, compression positive
  double shear_stress = 0.0;       ///< shear stress on the planes that resists the motion
  double shear_strain = 0.0;       ///< displacement along the planes, divided by the height of the sample
  double volumetric_strain = 0.0;  ///< logarithmic strain of the height, positive if the sample becomes lower

  PlaneStress stress() const { return {normal_stress, shear_stress}; }
  /// Returns the shear stress (with its sign) divided by the normal stress. Without cohesion, this is the tangent of
  /// the mobilised friction angle.
  double mobilised() const { return normal_stress > 0.0 ? shear_stress / normal_stress : 0.0; }
};

/// Results that a laboratory reports for one test of simple shear.
struct SimpleShearTest {
  std::string failure_reason;  ///< reason why the test gives no strength; empty if there is a strength
  PlaneStress peak_stress;     ///< stresses at the largest mobilised friction
  /// Mean stresses over the last part of the test; absent if the test has not reached a critical state.
  std::optional<PlaneStress> critical_stress;
  /// The parameters secant_angle_peak, strain_peak, dilatancy_angle and, with a critical state, secant_angle_critical.
  std::vector<FittedParameter> parameters;
  std::vector<std::string> warnings;

  bool found() const { return failure_reason.empty(); }
};

/// Evaluates one test of simple shear. The friction angle phi follows from the stresses on the planes: tan phi =
/// tau/sigma, with the shear stress tau and the normal stress sigma. The dilatancy angle psi follows from the points
/// around the peak (volume_at_peak()): tan psi is minus the slope of the volumetric strain against the shear strain.
/// The critical state is the mean over the last part of the test (critical_part()), with an interval from
/// mean_along_path().
/// @param points         states of the test, beginning with the state before the test
/// @param critical_from  shear strain at which the critical state begins; if absent, the critical state is taken from
/// the last quarter of the strain of the test
[[nodiscard]] SimpleShearTest evaluate_simple_shear_test(const std::vector<PlaneShearPoint>& points,
                                                         const std::optional<double>& critical_from);

}  // namespace floc
