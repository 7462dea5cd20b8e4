#pragma once

#include <optional>

#include "floc/relaxation/relaxation_options.h"

namespace floc {

/// Options for the response of the packing to its load during one stage of a run (the assembly or a stage of the load
/// path). During that stage, each member that is set replaces the corresponding member of RelaxationOptions.
struct CellResponse {
  std::optional<double> inertial_number_cap;
  std::optional<double> cell_mass;
  std::optional<double> wall_speed = {};
  /// Cap on the strain rate |L'/L| of the cell, in 1/T0 (RelaxationOptions::strain_rate_cap); not set together with
  /// inertial_number_cap.
  std::optional<double> strain_rate_cap = {};
  /// Value that replaces RelaxationOptions::softening during this stage.
  std::optional<double> softening = {};
  /// Value that replaces RelaxationOptions::time_step during this stage.
  std::optional<double> time_step = {};
  /// Strain rate of a packing of rigid grains (ContactDynamicsOptions::inertial_number).
  std::optional<double> inertial_number = {};

  bool has_cap() const { return inertial_number_cap || strain_rate_cap; }

  /// Returns this response with its unset members taken from `other`. If this response sets inertial_number_cap or
  /// strain_rate_cap, neither is taken from `other`.
  CellResponse or_else(const CellResponse& other) const {
    CellResponse out = *this;
    if (!has_cap()) {
      out.inertial_number_cap = other.inertial_number_cap;
      out.strain_rate_cap = other.strain_rate_cap;
    }
    if (!cell_mass) out.cell_mass = other.cell_mass;
    if (!wall_speed) out.wall_speed = other.wall_speed;
    if (!softening) out.softening = other.softening;
    if (!time_step) out.time_step = other.time_step;
    if (!inertial_number) out.inertial_number = other.inertial_number;
    return out;
  }

  RelaxationOptions applied_to(RelaxationOptions options) const {
    if (has_cap()) {
      options.inertial_number_cap = inertial_number_cap;
      options.strain_rate_cap = strain_rate_cap;
    }
    if (cell_mass) options.cell_mass = *cell_mass;
    if (wall_speed) options.compaction.wall_speed = wall_speed;
    if (softening) options.softening = *softening;
    if (time_step) options.time_step = *time_step;
    if (inertial_number) options.contact_dynamics.inertial_number = *inertial_number;
    return options;
  }
};

}  // namespace floc
