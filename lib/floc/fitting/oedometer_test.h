#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "floc/fitting/fitted_parameter.h"
#include "floc/fitting/shear_test.h"

namespace floc {

/// Results that a laboratory reports for one oedometer test (a compression without lateral strain).
struct OedometerTest {
  std::string failure_reason;  ///< reason why there are no parameters; empty if there are parameters
  /// Parameters K0 (lateral stress divided by axial stress) and constrained_modulus (unit of the stresses).
  std::vector<FittedParameter> parameters;
  /// Range of axial stresses over which the constrained modulus is evaluated.
  std::pair<double, double> modulus_range;

  bool found() const { return failure_reason.empty(); }
};

/// Evaluates the first loading of an oedometer test.
///
/// K0 is the mean of lateral stress divided by axial stress, with an interval from mean_along_path(). The mean begins
/// at three times the first axial stress, because the influence of the isotropic initial stress decays only gradually.
/// The constrained modulus is the secant (s_high - s_low)/(eps_high - eps_low) between two axial stresses s_low and
/// s_high. The logarithmic axial strains eps_low and eps_high at these stresses are interpolated linearly in the
/// logarithm of the stress.
/// @param points  states of the test, beginning with the state before the test
/// @param range   axial stresses s_low and s_high; if absent, half of the largest stress and the largest stress
[[nodiscard]] OedometerTest evaluate_oedometer_test(const std::vector<ShearPoint>& points,
                                                    const std::optional<std::pair<double, double>>& range);

}  // namespace floc
