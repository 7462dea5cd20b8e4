#pragma once

#include <algorithm>

#include "floc/relaxation/relaxation_options.h"

namespace floc {

/// Returns the keyword that a scene uses for a method of finding equilibria: "auto", "dynamic" or "static".
constexpr const char* finish_name(Finish finish) {
  return finish == Finish::automatic ? "auto" : finish == Finish::dynamic ? "dynamic" : "static";
}

/// Numerical settings of a run that trade speed for accuracy and do not change the physics.
struct NumericalSettings {
  /// tolerance of forces, moments and stresses; energy() follows from it
  double tolerance = 1e-5;
  /// time step in units of sqrt(m_min/K_N), with the mass m_min of the smallest grain and the normal stiffness K_N
  double time_step = RelaxationOptions{}.time_step;
  Finish finish = Finish::automatic;
  double patience = 1.0;

  /// Returns the tolerance of the kinetic energy for this tolerance of forces; it is 5e-8 for a tolerance of 1e-5 and
  /// below. This energy determines when motion counts as stopped. The remaining motion is removed afterwards, so a
  /// stricter tolerance is not needed.
  double energy() const { return 5e-3 * std::max(tolerance, 1e-5); }

  /// Writes these settings into the options.
  void apply(RelaxationOptions& options) const {
    options.tolerance = {tolerance, tolerance, tolerance, energy()};
    options.time_step = time_step;
    options.finish = finish;
    options.patience = patience;
  }

  /// Returns the settings contained in the options; `tolerance` is the tolerance of forces.
  static NumericalSettings of(const RelaxationOptions& options) {
    return {options.tolerance.force, options.time_step, options.finish, options.patience};
  }

  bool operator==(const NumericalSettings&) const = default;
};

}  // namespace floc
