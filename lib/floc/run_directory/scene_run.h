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

/// Options for running a scene in a directory (options of `floc run`).
struct SceneRunOptions {
  std::string directory;
  std::optional<std::uint64_t> seed;  ///< replaces the seed of the scene
  std::optional<int> threads;         ///< replaces the number of threads of the scene
  std::optional<int> until;           ///< number of the equilibrium after which the run stops
  /// if present, contacts.csv is written, with this simulated time between two rows (time unit of the scene)
  std::optional<double> track_contacts;
  bool track_energy = false;
  bool resume = false;
  bool overwrite = false;
  bool no_timing = false;
};

/// Returns the options for running a scene, with no more threads than are useful (useful_threads()).
/// @throws InputError, before any file is written, if the scene cannot be run with these options
RunOptions checked_options(const Scene& scene, const SceneRunOptions& asked);

/// Returns a text that says how many of the requested threads the run leaves unused, and why; empty if it uses all of
/// them.
std::string unused_threads(const Scene& scene, const SceneRunOptions& asked);

/// A run of a scene in its directory, ready to be driven, and a table that is recorded while the packing moves.
template <int Dim>
struct SceneRun {
  RunOptions options;
  RunDirectory directory;
  Run<Dim> run;
  /// table of contacts or energies recorded while the packing moves; null if there is none
  std::unique_ptr<MotionTable<Dim>> table;

  /// Begins the run or resumes it.
  /// @throws InputError if the scene cannot be run, or if the directory contains another run, or this run while neither
  /// resume nor overwrite is set
  SceneRun(const Scene& scene, const SceneRunOptions& asked);

  /// Drives the run.
  /// @param watch  functions that are called to report progress; the other options in it are replaced by those given to
  /// the constructor
  [[nodiscard]] DriveReport drive(DriveOptions<Dim> watch);

 private:
  double checkpoint_every_;
  std::optional<int> until_;
  bool timing_;
};

/// Runs a scene in one call, like the command `floc run`: to its end, or until the function `stop` returns true. The
/// run then stops at a checkpoint, from which another call with `asked.resume` continues it.
/// @param scene_file  scene (TOML)
/// @param changes  texts "key=value", each of which replaces a value of the scene
/// @param stop  function called between chunks of time steps, which stops the run by returning true; if empty, the run
/// continues to its end
/// @return report whose `outcome` is done, stopped, or gave_up if an equilibrium was not reached
/// @throws InputError if read_scene() or the constructor of SceneRun does, IoError if the directory cannot be written
[[nodiscard]] DriveReport run_scene(const std::string& scene_file, const SceneRunOptions& asked,
                                    const std::vector<std::string>& changes = {},
                                    const std::function<bool()>& stop = {});

/// Returns the treatment of an existing directory of a run, which follows from the options resume and overwrite.
Existing existing_of(const SceneRunOptions& asked);

/// Returns a description of how a run ended that has not made all its equilibria; empty if it is done.
template <int Dim>
std::string ending_of(const DriveReport& report, const Run<Dim>& run);

}  // namespace floc
