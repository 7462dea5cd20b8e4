#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/fitting/fitted_parameter.h"
#include "floc/fitting/mohr_coulomb.h"

namespace floc {

/// One state of a test that shortens (or lengthens) a sample along an axis. Stresses and logarithmic strains are
/// positive in compression; strains count from the beginning of the test.
struct ShearPoint {
  double axial_stress = 0.0;
  double lateral_stress = 0.0;  ///< mean over the other axes
  double axial_strain = 0.0;
  double volumetric_strain = 0.0;

  FailureStress failure() const;
  /// (sigma_1 - sigma_3)/(sigma_1 + sigma_3), the sine of the mobilised friction angle without cohesion.
  double mobilised() const;
};

/// Results that a laboratory reports of one biaxial or triaxial test, drained (the lateral stress is kept) or undrained (the
/// volume is kept).
struct ShearTest {
  std::string failure_reason;  ///< reason why the test has no strength; empty if it has
  int peak = 0;                ///< index of the point of largest mobilised friction
  FailureStress peak_stress;
  /// Means over the last part of the test; absent if the test has not come to a critical state.
  std::optional<FailureStress> critical_stress;
  /// secant_angle_peak, secant_angle_critical, strain_peak, dilatancy_angle and, of undrained tests,
  /// undrained_strength_peak, undrained_strength_critical and pore_pressure_coefficient
  std::vector<FittedParameter> parameters;
  std::vector<std::string> warnings;

  bool found() const { return failure_reason.empty(); }
};

struct ShearTestOptions {
  /// Magnitude of the axial strain from which on the sample is in its critical state; absent: the last quarter of the
  /// strain of the test.
  std::optional<double> critical_from;
  bool undrained = false;  ///< whether the volume is kept
};

/// Evaluates one test.
///
/// The peak is the point of largest mobilised friction. The dilatancy angle psi at the peak follows from the slope of
/// the volumetric strain against the axial strain over the points around the peak with at least 95 % of its friction,
/// five at least:
/// sin psi = -d eps_v/(2 d eps_1 - d eps_v) [VB1984], which in two dimensions is -d eps_v/(d eps_1 - d eps_2). The critical state is the mean over the last part of the test, with the interval of its
/// fluctuations (see mean_along_path()). It is left out if the volume still changes there by more than a tenth of the
/// axial strain. The undrained strength is (sigma_1 - sigma_3)/2, and the pore pressure coefficient at the peak is
/// [S1954] the pore pressure over the rise of the deviator, as if the lateral total
/// stress were kept: A = (sigma_3 at the start - sigma_3)/(deviator - deviator at the start).
/// @param points  states of the test, the first one before it
[[nodiscard]] ShearTest evaluate_shear_test(const std::vector<ShearPoint>& points,
                                            const ShearTestOptions& options);

}  // namespace floc
