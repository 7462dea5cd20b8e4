#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "floc/loading/run_options.h"

namespace floc {

/// Largest number of grains of a packing. Up to this number, the unknowns of its equilibrium (three per disk, six per
/// sphere) can be counted by an int.
inline constexpr std::int64_t kMaxGrains = 100'000'000;

/// Content of a scene file: the options of a run, the name of the scene and the interval of checkpoints, and texts that
/// describe how the file was read.
struct Scene : RunOptions {
  std::string name;
  double checkpoint_every = 60.0;  ///< wall time between two checkpoints (s)
  /// description of the saved packing from which the run starts; empty if it does not start from a saved packing
  std::string start;
  /// remarks about the file of shapes, for example about points that are not vertices of the shape
  std::vector<std::string> remarks;
  /// sentence with the numerical settings chosen from the table [accuracy], and the reason for the choice; empty
  /// without this table
  std::string accuracy;

  bool starts_from_state() const { return assembly.protocol == AssemblyOptions::Protocol::state; }
  /// Whether runs of the scene with different seeds give different packings. This is false only for a run that starts
  /// from a saved packing whose grains are at rest and not vibrated.
  bool is_random() const {
    return !starts_from_state() || assembly.agitation > 0.0 || assembly.vibration.has_value();
  }
};

}  // namespace floc
