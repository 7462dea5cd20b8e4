#pragma once

#include <string>
#include <vector>

#include "floc/fitting/fitted_parameter.h"
#include "floc/fitting/residual_pattern.h"

namespace floc {

/// Power law of an elastic modulus, or the reason why there is none.
struct ModulusLaw {
  std::string failure_reason;  ///< reason why there is no fit; empty if there is one
  /// exponent and coefficient, with phi_0 between them in a law of the solid fraction
  std::vector<FittedParameter> parameters;
  double rms = 0.0;         ///< root mean square residual of the logarithm of the modulus
  ResidualPattern pattern;  ///< pattern in the residuals, in the order of the points
  std::vector<std::string> warnings;

  bool found() const { return failure_reason.empty(); }
};

/// Fits the power law M = coefficient P^exponent of a modulus M of a packing under the pressure P by least squares in
/// ln M, that is, for errors in proportion to M. Intervals are those of Student's t, widened by the correlation of the
/// residuals where these are systematic.
/// @param P  pressures, > 0, in growing order, four or more   @param modulus  > 0, one per pressure
[[nodiscard]] ModulusLaw fit_modulus_of_pressure(const std::vector<double>& P,
                                                 const std::vector<double>& modulus);

/// Fits the power law M = coefficient (Phi - phi_0)^exponent of a modulus M of packings of the solid fraction Phi by least
/// squares in ln M. phi_0, where the modulus vanishes, lies between 0 and the smallest Phi. Intervals of the exponent and of
/// phi_0 are those of the profile of the sum of squares, widened as above; an end that the data do not tell is absent.
/// @param phi  solid fractions, > 0, in growing order, six or more   @param modulus  > 0, one per solid fraction
[[nodiscard]] ModulusLaw fit_modulus_of_fraction(const std::vector<double>& phi,
                                                 const std::vector<double>& modulus);

}  // namespace floc
