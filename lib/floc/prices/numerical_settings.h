#pragma once

#include <algorithm>

#include "floc/relaxation/relaxation_options.h"

namespace floc {

/// Returns the keyword by which a scene selects a method of finding equilibria: "auto", "dynamic" or "static".
constexpr const char* finish_name(Finish finish) {
  return finish == Finish::automatic ? "auto" : finish == Finish::dynamic ? "dynamic" : "static";
}

/// Returns the keyword by which a scene selects the masses with which grains move: "own" or "equal".
constexpr const char* masses_name(bool equal) {
  return equal ? "equal" : "own";
}

/// Factors >= 1 by which the stiffness of springs is divided while grains rearrange (RelaxationOptions::softening).
struct Softening {
  double assembly = 1.0;  ///< factor while the grains are put together
  /// largest factor of all stages of the load path; if there are no stages, the factor of the assembly
  double load = 1.0;

  bool any() const { return assembly > 1.0 || load > 1.0; }
  bool operator==(const Softening&) const = default;
};

/// Numerical settings of a run. They determine the speed and the accuracy of the run, but do not change the physics.
struct NumericalSettings {
  /// tolerance of net forces and moments on grains, and of stresses; it also determines energy()
  double tolerance = 1e-5;
  /// time step in units of sqrt(m_min/K_N), where m_min is the mass of the smallest grain and K_N the normal stiffness
  /// of a contact
  double time_step = RelaxationOptions{}.time_step;
  Finish finish = Finish::automatic;
  double patience = 1.0;
  /// apply() and of() ignore this member, because parts of a run may have different factors (scene/scene_softening.h).
  Softening softening = {};
  bool equal_masses = false;  ///< see RelaxationOptions::equal_masses

  /// Returns the tolerance of the kinetic energy. A packing with a lower energy counts as at rest. The result is 5e-3
  /// times `tolerance`, but at least 5e-8. A stricter value is not needed, because the remaining motion is removed
  /// afterwards.
  double energy() const { return 5e-3 * std::max(tolerance, 1e-5); }

  /// Whether a packing may collapse to another state than with springs of the contact law and the own masses of the
  /// grains. Such states are compared by their means alone.
  bool changes_path() const { return softening.any() || equal_masses; }

  /// Writes these settings into the options of a relaxation.
  void apply(RelaxationOptions& options) const {
    options.tolerance = {tolerance, tolerance, tolerance, energy()};
    options.time_step = time_step;
    options.finish = finish;
    options.patience = patience;
    options.equal_masses = equal_masses;
  }

  /// Returns the settings in the options of a relaxation. The member `tolerance` of the result is the tolerance of
  /// forces in the options.
  static NumericalSettings of(const RelaxationOptions& options) {
    return {.tolerance = options.tolerance.force,
            .time_step = options.time_step,
            .finish = options.finish,
            .patience = options.patience,
            .equal_masses = options.equal_masses};
  }

  bool operator==(const NumericalSettings&) const = default;
};

/// Settings of contact dynamics that are priced together, in the rows "together" of tables for rigid grains.
struct RigidSettingsTogether {
  const char* value;       ///< value of the parameter "together" in tables of prices
  double time_step;        ///< see ContactDynamicsOptions::time_step
  double sweep_tolerance;  ///< see ContactDynamicsOptions::sweep_tolerance
};

inline constexpr RigidSettingsTogether kRigidTogether[] = {
    {"coarse", 0.1, 0.1}, {"medium", 0.1, 1e-2}, {"careful", 0.025, 1e-4}};

}  // namespace floc
