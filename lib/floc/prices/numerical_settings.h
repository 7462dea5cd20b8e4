#pragma once

#include <algorithm>

#include "floc/relaxation/relaxation_options.h"

namespace floc {

/// Returns the keyword of a scene for a method of finding equilibria: "auto", "dynamic" or "static".
constexpr const char* finish_name(Finish finish) {
  return finish == Finish::automatic ? "auto" : finish == Finish::dynamic ? "dynamic" : "static";
}

/// Factors by which springs are softer while grains rearrange (RelaxationOptions::softening), >= 1.
struct Softening {
  double assembly = 1.0;  ///< factor while the grains are put together
  double load = 1.0;  ///< largest factor of all stages of the load path; that of the assembly without stages

  bool any() const { return assembly > 1.0 || load > 1.0; }
  bool operator==(const Softening&) const = default;
};

/// Numerical settings of a run, which determine its speed and accuracy but not the physics.
struct NumericalSettings {
  /// tolerance of net forces and moments on grains, and of stresses; it also determines energy()
  double tolerance = 1e-5;
  /// time step in units of sqrt(m_min/K_N), with the mass m_min of the smallest grain and the normal stiffness K_N of a
  /// contact
  double time_step = RelaxationOptions{}.time_step;
  Finish finish = Finish::automatic;
  double patience = 1.0;
  /// Parts of a run may have different factors, so apply() and of() leave this member out (scene/scene_softening.h).
  Softening softening = {};

  /// Returns the tolerance of the kinetic energy: below it, the packing counts as at rest. It is proportional to
  /// `tolerance`, but at least 5e-8, its value for tolerance = 1e-5. A stricter value is not needed, because the
  /// remaining motion is removed afterwards.
  double energy() const { return 5e-3 * std::max(tolerance, 1e-5); }

  /// Writes these settings into the options of a relaxation.
  void apply(RelaxationOptions& options) const {
    options.tolerance = {tolerance, tolerance, tolerance, energy()};
    options.time_step = time_step;
    options.finish = finish;
    options.patience = patience;
  }

  /// Returns the settings that the options of a relaxation contain. `tolerance` is set to the force tolerance of the
  /// options.
  static NumericalSettings of(const RelaxationOptions& options) {
    return {options.tolerance.force, options.time_step, options.finish, options.patience};
  }

  bool operator==(const NumericalSettings&) const = default;
};

}  // namespace floc
