#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "floc/fitting/fitted_parameter.h"
#include "floc/fitting/shear_test.h"

namespace floc {

/// Results that a laboratory reports of one compression without lateral strain.
struct OedometerTest {
  std::string failure_reason;  ///< reason why there are no parameters; empty if there are
  /// K0 (lateral over axial stress) and constrained_modulus (unit of the stresses)
  std::vector<FittedParameter> parameters;
  /// Range of axial stresses of the constrained modulus.
  std::pair<double, double> modulus_range;

  bool found() const { return failure_reason.empty(); }
};

/// Evaluates the first loading of an oedometer test.
///
/// K0 is the mean of lateral over axial stress from three times the first axial stress on, with the interval of its
/// fluctuations (see mean_along_path()): a sample forgets the isotropic stress with which it began only gradually. The
/// constrained modulus is the secant (s_high - s_low)/(eps_high - eps_low) between two axial stresses, at which the
/// logarithmic axial strain is interpolated linearly in the logarithm of the stress.
/// @param points  states of the test, the first one before it
/// @param range   axial stresses of the modulus; absent: from half of the largest stress to it
[[nodiscard]] OedometerTest evaluate_oedometer_test(const std::vector<ShearPoint>& points,
                                                    const std::optional<std::pair<double, double>>& range);

}  // namespace floc
