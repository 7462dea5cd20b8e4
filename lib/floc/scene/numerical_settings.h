#pragma once

#include <algorithm>

#include "floc/relaxation/relaxation_options.h"

namespace floc {

/// Returns the keyword of a scene for a finish: "auto", "dynamic" or "static".
constexpr const char* finish_name(Finish finish) {
  return finish == Finish::automatic ? "auto" : finish == Finish::dynamic ? "dynamic" : "static";
}

/// Settings of a run that trade speed for accuracy and do not change its physics.
struct NumericalSettings {
  double tolerance = 1e-5;                           ///< for force, moment and stress; energy() follows from it
  double time_step = RelaxationOptions{}.time_step;  ///< time step in sqrt(m_min/K_N)
  Finish finish = Finish::automatic;
  double patience = 1.0;

  /// Returns the tolerance of the kinetic energy that belongs to the tolerance of forces: 5e-8 for a tolerance of
  /// 1e-5 and below. It decides when motion has stopped; the remaining motion is then removed, so a stricter value is
  /// not needed.
  double energy() const { return 5e-3 * std::max(tolerance, 1e-5); }

  /// Writes these settings into the options.
  void apply(RelaxationOptions& options) const {
    options.tolerance = {tolerance, tolerance, tolerance, energy()};
    options.time_step = time_step;
    options.finish = finish;
    options.patience = patience;
  }

  /// Returns the settings in the options; their tolerance is that of forces.
  static NumericalSettings of(const RelaxationOptions& options) {
    return {options.tolerance.force, options.time_step, options.finish, options.patience};
  }

  bool operator==(const NumericalSettings&) const = default;
};

}  // namespace floc
