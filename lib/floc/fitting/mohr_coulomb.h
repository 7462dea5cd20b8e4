#pragma once

#include <string>
#include <vector>

#include "floc/fitting/fitted_parameter.h"

namespace floc {

/// Largest and smallest principal stress of a sample at failure (compression positive).
struct FailureStress {
  double major = 0.0;
  double minor = 0.0;
};

/// Stresses at failure, on the planes along which a sample fails.
struct PlaneStress {
  double normal = 0.0;  ///< normal stress on the planes, compression positive
  double shear = 0.0;   ///< shear stress along the planes
};

/// Mohr-Coulomb line fitted to the stresses of several samples at failure, or the reason why there is no fit.
struct MohrCoulombFit {
  std::string failure_reason;  ///< reason why there is no fit; empty if there is one
  FittedParameter angle;       ///< friction angle (degrees)
  FittedParameter cohesion;    ///< cohesion (unit of the stresses)
  /// Root mean square of the relative residuals of the fitted stress: sigma_1, or the shear stress on planes.
  double rms = 0.0;
  std::vector<std::string> warnings;

  bool found() const { return failure_reason.empty(); }
};

/// Fits the Mohr-Coulomb criterion tau = c + sigma tan(phi) to the stresses of at least three samples. The criterion is
/// written with the principal stresses sigma_1 and sigma_3, the cohesion c and the friction angle phi:
///
///   sigma_1 = N sigma_3 + 2 c sqrt(N),   N = (1 + sin phi)/(1 - sin phi),
///
/// The errors of sigma_1 are assumed to be in proportion to sigma_1, as is the scatter of strengths under equal lateral
/// stress. Intervals follow from Student's t; the interval of the angle is symmetric in ln N.
/// @param suffix  end of the names of both parameters, such as "_peak"
[[nodiscard]] MohrCoulombFit fit_mohr_coulomb(const std::vector<FailureStress>& stresses,
                                              const std::string& suffix);

/// Fits the Mohr-Coulomb line tau = c + sigma tan(phi) to the stresses on the failure planes of at least three samples.
/// Tests of simple shear and with a shear box give these stresses. The errors of tau are assumed to be in proportion to
/// tau. The interval of the angle is symmetric in the tangent of the angle.
/// @param suffix  end of the names of both parameters, such as "_peak"
[[nodiscard]] MohrCoulombFit fit_mohr_coulomb_planes(const std::vector<PlaneStress>& stresses,
                                                     const std::string& suffix);

/// Returns asin[(major - minor)/(major + minor)] (degrees). This is the friction angle if the sample has no cohesion,
/// so that its Mohr-Coulomb line goes through the origin.
double secant_angle(const FailureStress& stress);

/// Returns the angle (degrees) with a given sine. Its interval follows from the interval of the sine.
FittedParameter angle_of_sine(const FittedParameter& sine);

/// Returns the angle (degrees) with the tangent `tangent`. Its interval follows from the interval of the tangent.
FittedParameter angle_of_tangent(const FittedParameter& tangent);

}  // namespace floc
