#pragma once

#include <cstdint>
#include <string>

#include "floc/loading/run_options.h"

namespace floc {

/// The unknowns of a packing (three per disk, six per sphere) are counted in an int.
inline constexpr std::int64_t kMaxGrains = 100'000'000;

/// A scene file, parsed: the options of a run, and what the program needs besides them.
struct Scene : RunOptions {
  std::string name;
  double checkpoint_every = 60.0;  ///< seconds of wall time between checkpoints
  std::string start;               ///< the saved packing that the run starts from, in words; empty without one
  std::string accuracy;            ///< setting that [accuracy] chose and why; empty without one

  bool starts_from_state() const { return assembly.protocol == AssemblyOptions::Protocol::state; }
  /// Whether another seed makes another sample: all are random but a saved packing that starts at rest.
  bool is_random() const {
    return !starts_from_state() || assembly.agitation > 0.0 || assembly.vibration.has_value();
  }
};

}  // namespace floc
