#pragma once

#include <string>
#include <vector>

#include "floc/fitting/fitted_parameter.h"

namespace floc {

/// Bulk modulus of a branch, or why there is none.
struct ElasticFit {
  std::string refusal;                      ///< empty when there is a fit
  std::vector<FittedParameter> parameters;  ///< B (unit of the pressures), phi_unloaded (at P = 0)
  /// B between the two lowest pressures; infinite or negative if Phi does not grow there.
  double secant_low = 0.0;
  double secant_high = 0.0;  ///< B between the two highest
  double rms = 0.0;          ///< root mean square residual of ln Phi
  std::vector<std::string> warnings;

  bool found() const { return refusal.empty(); }
};

/// Bulk modulus from dPhi/Phi = dP/B: the straight line ln Phi = ln Phi_0 + P/B by least
/// squares. Says so if the branch is curved. Refused with fewer than three points, or if Phi does not fall as P
/// does.
/// @param P    pressures, >= 0, growing or falling   @param phi  solid fractions, > 0; as many
[[nodiscard]] ElasticFit fit_elastic(const std::vector<double>& P, const std::vector<double>& phi);

}  // namespace floc
