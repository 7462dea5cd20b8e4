#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "floc/run_directory/drive.h"
#include "floc/run_directory/motion_table.h"
#include "floc/scene/scene.h"

namespace floc {

/// Options for running a scene in a directory. They correspond to the options of the command `floc run`.
struct SceneRunOptions {
  std::string directory;
  std::optional<std::uint64_t> seed;  ///< replaces the seed of the scene
  std::optional<int> threads;         ///< replaces the number of threads of the scene
  /// number (from 0) of the equilibrium after which the run stops; if absent, the run continues to its end
  std::optional<int> until;
  /// simulated time between two rows of the table contacts.csv (time unit of the scene); if absent, the table is not
  /// written
  std::optional<double> track_contacts;
  bool track_energy = false;
  bool resume = false;
  bool overwrite = false;
  bool no_timing = false;
};

/// Returns the options of a run: the options of its scene, changed by `asked`. The number of threads is at most the
/// result of useful_threads().
/// @throws InputError if the scene cannot be run with these options; this function writes no files
RunOptions checked_options(const Scene& scene, const SceneRunOptions& asked);

/// Returns a message if the run uses fewer threads than requested: the number of unused threads, and the reason. Empty
/// if the run uses all requested threads.
std::string unused_threads(const Scene& scene, const SceneRunOptions& asked);

/// A run of a scene: the run, its directory, and the table that records the motion of the packing.
template <int Dim>
struct SceneRun {
  RunOptions options;
  RunDirectory directory;
  Run<Dim> run;
  /// table of contacts or energies that is recorded while the packing moves; null for none
  std::unique_ptr<MotionTable<Dim>> table;

  /// Begins a new run in the directory, or resumes the run in it.
  /// @throws InputError if the scene cannot be run, if the directory contains the run of another scene, or if it
  /// contains a run although neither `asked.resume` nor `asked.overwrite` is set
  SceneRun(const Scene& scene, const SceneRunOptions& asked);

  /// Drives the run: computes its equilibria and saves them in its directory.
  /// @param watch  functions that are called to report progress; all other options in `watch` are ignored, because the
  /// values given to the constructor are used
  [[nodiscard]] DriveReport drive(DriveOptions<Dim> watch);

 private:
  double checkpoint_every_;
  std::optional<int> until_;
  bool timing_;
};

/// Runs a scene in one call, like the command `floc run`. The run ends after the last equilibrium, or when `stop`
/// returns true. A run that is stopped writes a checkpoint, from which a later call with `asked.resume` continues it.
/// @param scene_file  name of the scene file (TOML)
/// @param changes  texts "key=value", each of which replaces a value of the scene
/// @param stop  function that is called between chunks of time steps and stops the run by returning true; if empty, the
/// run continues to its end
/// @return report whose `outcome` is `done`, `stopped`, or `gave_up` if an equilibrium was not reached
/// @throws InputError if read_scene() or the constructor of SceneRun refuses the scene, IoError if the directory cannot
/// be written
[[nodiscard]] DriveReport run_scene(const std::string& scene_file, const SceneRunOptions& asked,
                                    const std::vector<std::string>& changes = {},
                                    const std::function<bool()>& stop = {});

/// Returns the treatment of a directory that already contains a run. It follows from the options `resume` and
/// `overwrite`.
Existing existing_of(const SceneRunOptions& asked);

/// Returns a message with the reason why a run ended before its last equilibrium; empty if the run is complete.
template <int Dim>
std::string ending_of(const DriveReport& report, const Run<Dim>& run);

}  // namespace floc
