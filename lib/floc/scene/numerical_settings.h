#pragma once

#include <algorithm>

#include "floc/relaxation/relaxation_options.h"

namespace floc {

/// The keyword of a scene: "auto", "dynamic" or "static".
constexpr const char* finish_name(Finish finish) {
  return finish == Finish::automatic ? "auto" : finish == Finish::dynamic ? "dynamic" : "static";
}

/// Settings of a run that trade speed for accuracy and leave its physics alone.
struct NumericalSettings {
  double tolerance = 1e-5;  ///< of force, moment and stress; that of the energy goes with it, see energy()
  double time_step = RelaxationOptions{}.time_step;  ///< in sqrt(m_min/K_N)
  Finish finish = Finish::automatic;
  double patience = 1.0;

  /// Tolerance of the kinetic energy that goes with the one of forces: 5e-8 with 1e-5 and below, since it
  /// decides when motion has stopped, and what is left of the motion is then taken out.
  double energy() const { return 5e-3 * std::max(tolerance, 1e-5); }

  /// Puts these settings into the options.
  void apply(RelaxationOptions& options) const {
    options.tolerance = {tolerance, tolerance, tolerance, energy()};
    options.time_step = time_step;
    options.finish = finish;
    options.patience = patience;
  }

  /// The settings in the options; their tolerance is that of forces.
  static NumericalSettings of(const RelaxationOptions& options) {
    return {options.tolerance.force, options.time_step, options.finish, options.patience};
  }

  bool operator==(const NumericalSettings&) const = default;
};

}  // namespace floc
