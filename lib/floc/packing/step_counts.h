#pragma once

#include <cstdint>

namespace floc {

/// Counts of the time steps that contact dynamics has made (contact_dynamics.h).
struct StepCounts {
  std::int64_t n_steps = 0;
  std::int64_t n_sweeps = 0;  ///< number of sweeps over all contacts in all steps
  /// number of steps that did not reach the tolerance within the largest allowed number of sweeps
  std::int64_t n_unfinished = 0;
  double deepest_overlap = 0.0;  ///< deepest overlap in any step, divided by the diameter of the smaller grain
};

}  // namespace floc
