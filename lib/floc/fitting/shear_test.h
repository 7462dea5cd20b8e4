#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/fitting/fitted_parameter.h"
#include "floc/fitting/mohr_coulomb.h"

namespace floc {

/// One state of a test that shortens or lengthens a sample along an axis. Stresses and logarithmic strains are positive
/// in compression. Strains are zero at the beginning of the test.
struct ShearPoint {
  double axial_stress = 0.0;
  double lateral_stress = 0.0;  ///< mean stress over the other axes
  double axial_strain = 0.0;
  double volumetric_strain = 0.0;

  FailureStress failure() const;
  /// Returns (sigma_1 - sigma_3)/(sigma_1 + sigma_3). Without cohesion, this is the sine of the mobilised friction
  /// angle.
  double mobilised() const;
};

/// Results that a laboratory reports for one biaxial or triaxial test. In a drained test, the lateral stress is
/// constant; in an undrained test, the volume is constant.
struct ShearTest {
  std::string failure_reason;  ///< reason why the test gives no strength; empty if there is a strength
  int peak = 0;                ///< index of the point of largest mobilised friction
  FailureStress peak_stress;
  /// Mean stress over the last part of the test; absent if the test has not reached a critical state.
  std::optional<FailureStress> critical_stress;
  /// The parameters secant_angle_peak, secant_angle_critical, strain_peak, dilatancy_angle and, for undrained
  /// tests, undrained_strength_peak, undrained_strength_critical and pore_pressure_coefficient.
  std::vector<FittedParameter> parameters;
  std::vector<std::string> warnings;

  bool found() const { return failure_reason.empty(); }
};

struct ShearTestOptions {
  /// Magnitude of the axial strain at which the critical state begins. If absent, the critical state is taken from the
  /// last quarter of the strain of the test.
  std::optional<double> critical_from;
  bool undrained = false;  ///< whether the volume is constant during the test
};

/// Evaluates one biaxial or triaxial test.
///
/// The peak is the point of largest mobilised friction. The dilatancy angle psi at the peak follows from the slope of
/// the volumetric strain eps_v against the axial strain eps_1. The slope is fitted to the points around the peak that
/// have at least 95 % of the largest mobilised friction, but at least to five points. The angle is given by sin psi =
/// -d eps_v/(2 d eps_1 - d eps_v) [VB1984]; in 2D, this equals -d eps_v/(d eps_1 - d eps_2).
///
/// The critical state is the mean over the last part of the test, with an interval from mean_along_path(). There is no
/// critical state if the volumetric strain in this part changes by more than a tenth of the change of the axial strain.
///
/// The undrained strength is (sigma_1 - sigma_3)/2. The pore pressure coefficient at the peak [S1954] is A = (sigma_3
/// at the start - sigma_3)/(deviator - deviator at the start), with the deviator sigma_1 - sigma_3. The numerator is
/// the pore pressure that would develop at constant total lateral stress.
/// @param points  states of the test, beginning with the state before the test
[[nodiscard]] ShearTest evaluate_shear_test(const std::vector<ShearPoint>& points,
                                            const ShearTestOptions& options);

}  // namespace floc
