#pragma once

#include <string>
#include <vector>

#include "floc/fitting/fitted_parameter.h"
#include "floc/fitting/residual_pattern.h"

namespace floc {

/// Power law of an elastic modulus, or the reason why there is no fit.
struct ModulusLaw {
  std::string failure_reason;  ///< reason why there is no fit; empty if there is one
  /// In this order: exponent, phi_0 (only in a power law in the solid fraction), coefficient.
  std::vector<FittedParameter> parameters;
  double rms = 0.0;         ///< root mean square residual of the logarithm of the modulus
  ResidualPattern pattern;  ///< pattern in the residuals, in the order of the points
  std::vector<std::string> warnings;

  bool found() const { return failure_reason.empty(); }
};

/// Fits the power law M = coefficient P^exponent to a modulus M at several pressures P. The fit is by least squares in
/// ln M, which assumes errors in proportion to M. Intervals follow from Student's t. If the residuals are systematic,
/// their correlation widens the intervals.
/// @param P  pressures, > 0, in growing order, four or more   @param modulus  > 0, one per pressure
[[nodiscard]] ModulusLaw fit_modulus_of_pressure(const std::vector<double>& P,
                                                 const std::vector<double>& modulus);

/// Fits the power law M = coefficient (Phi - phi_0)^exponent to a modulus M at several solid fractions Phi, by least
/// squares in ln M. The modulus vanishes at the solid fraction phi_0, which lies between 0 and the smallest Phi.
/// Intervals follow from the profile of the sum of squares, and are widened if the residuals are systematic. An end of
/// an interval is absent if the data do not determine it.
/// @param phi  solid fractions, > 0, in growing order, six or more   @param modulus  > 0, one per solid fraction
[[nodiscard]] ModulusLaw fit_modulus_of_fraction(const std::vector<double>& phi,
                                                 const std::vector<double>& modulus);

}  // namespace floc
