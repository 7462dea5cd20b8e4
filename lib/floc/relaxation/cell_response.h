#pragma once

#include <optional>

#include "floc/relaxation/relaxation_options.h"

namespace floc {

/// How the cell, or the walls, answer to their load in a part of a run, where that differs from the rest
/// (RelaxationOptions).
struct CellResponse {
  std::optional<double> inertial_number_cap;
  std::optional<double> cell_mass;
  std::optional<double> wall_speed = {};

  RelaxationOptions applied_to(RelaxationOptions options) const {
    if (inertial_number_cap) {
      options.inertial_number_cap = inertial_number_cap;
      options.strain_rate_cap.reset();
    }
    if (cell_mass) options.cell_mass = *cell_mass;
    if (wall_speed) options.compaction.wall_speed = wall_speed;
    return options;
  }
};

}  // namespace floc
