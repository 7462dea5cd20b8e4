#pragma once

#include <cstdint>
#include <string>

#include "floc/loading/run_options.h"

namespace floc {

/// Largest number of grains of a packing. Its unknowns (three per disk, six per sphere) are counted in an int.
inline constexpr std::int64_t kMaxGrains = 100'000'000;

/// Content of a scene file: the options of a run, and further data that the program needs.
struct Scene : RunOptions {
  std::string name;
  double checkpoint_every = 60.0;  ///< wall time between two checkpoints (s)
  /// description of the saved packing from which the run starts; empty if it does not start from a saved packing
  std::string start;
  /// settings chosen for the table [accuracy], with the reason; empty without this table
  std::string accuracy;

  bool starts_from_state() const { return assembly.protocol == AssemblyOptions::Protocol::state; }
  /// Whether another seed gives another sample. Every start is random, except a saved packing whose grains are at rest
  /// and are not vibrated.
  bool is_random() const {
    return !starts_from_state() || assembly.agitation > 0.0 || assembly.vibration.has_value();
  }
};

}  // namespace floc
