#pragma once

#include <cstdint>
#include <string>

#include "floc/loading/run_options.h"

namespace floc {

/// Largest number of grains: the unknowns of a packing (three per disk, six per sphere) are counted in an int.
inline constexpr std::int64_t kMaxGrains = 100'000'000;

/// A parsed scene file: the options of a run, and the further data that the program needs.
struct Scene : RunOptions {
  std::string name;
  double checkpoint_every = 60.0;  ///< seconds of wall time between checkpoints
  std::string start;               ///< saved packing at the start, in words; empty without one
  std::string accuracy;            ///< setting that [accuracy] chose, with the reason; empty without it

  bool starts_from_state() const { return assembly.protocol == AssemblyOptions::Protocol::state; }
  /// Whether another seed makes another sample. The only start that is not random is a saved packing at rest.
  bool is_random() const {
    return !starts_from_state() || assembly.agitation > 0.0 || assembly.vibration.has_value();
  }
};

}  // namespace floc
