#pragma once

#include <string>
#include <vector>

#include "floc/fitting/fitted_parameter.h"

namespace floc {

/// Largest and smallest principal stress of a sample that fails (stress, compression positive).
struct FailureStress {
  double major = 0.0;
  double minor = 0.0;
};

/// Stresses on the planes along which a sample fails.
struct PlaneStress {
  double normal = 0.0;  ///< across the planes, compression positive
  double shear = 0.0;   ///< along the planes
};

/// Mohr-Coulomb line through the stresses of several samples at failure, or the reason why there is none.
struct MohrCoulombFit {
  std::string failure_reason;  ///< reason why there is no fit; empty if there is one
  FittedParameter angle;       ///< friction angle (degrees)
  FittedParameter cohesion;    ///< cohesion (unit of the stresses)
  /// Root mean square of the relative residuals of the major stress, or of the shear stress.
  double rms = 0.0;
  std::vector<std::string> warnings;

  bool found() const { return failure_reason.empty(); }
};

/// Fits the Mohr-Coulomb criterion tau = c + sigma tan(phi) in the form of its principal stresses,
///
///   sigma_1 = N sigma_3 + 2 c sqrt(N),   N = (1 + sin phi)/(1 - sin phi),
///
/// to the stresses of at least three samples. The fit assumes relative errors of sigma_1, because the strengths
/// of samples under equal lateral stress differ by a fraction of their value. Intervals follow from Student's
/// t; that of the angle is symmetric in ln N.
/// @param suffix  end of the names of both parameters, such as "_peak"
[[nodiscard]] MohrCoulombFit fit_mohr_coulomb(const std::vector<FailureStress>& stresses,
                                              const std::string& suffix);

/// Fits the line tau = c + sigma tan(phi) of Mohr and Coulomb to the stresses on the planes of at least three samples, as
/// tests of simple shear and of a shear box give them. The errors of tau count relative to its value, and the interval of the
/// angle is symmetric in its tangent.
/// @param suffix  end of the names of both parameters, such as "_peak"
[[nodiscard]] MohrCoulombFit fit_mohr_coulomb_planes(const std::vector<PlaneStress>& stresses,
                                                     const std::string& suffix);

/// Returns asin[(major - minor)/(major + minor)] (degrees): the friction angle of a cohesionless sample, whose
/// Mohr-Coulomb line goes through the origin.
double secant_angle(const FailureStress& stress);

/// Returns the angle (degrees) that belongs to a given sine, with the interval that follows from that of the
/// sine.
FittedParameter angle_of_sine(const FittedParameter& sine);

/// Returns the angle whose tangent is `tangent` (degrees), with the interval of the tangent.
FittedParameter angle_of_tangent(const FittedParameter& tangent);

}  // namespace floc
