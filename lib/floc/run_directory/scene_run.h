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

/// Options of running a scene in a directory.
struct SceneRunOptions {
  std::string directory;
  std::optional<std::uint64_t> seed;     ///< replaces that of the scene
  std::optional<int> threads;            ///< replaces that of the scene
  std::optional<int> until;              ///< number of the equilibrium after which the run stops
  std::optional<double> track_contacts;  ///< simulated time between two rows
  bool track_energy = false;
  bool resume = false;
  bool overwrite = false;
  bool no_timing = false;
};

/// Returns the options of the run of a scene, with no more threads than are useful (useful_threads()).
/// @throws InputError, before anything is written, for options that no run of the scene can satisfy
RunOptions checked_options(const Scene& scene, const SceneRunOptions& asked);

/// Describes the threads that the run leaves unused, with the reason; empty if it uses all requested ones.
std::string unused_threads(const Scene& scene, const SceneRunOptions& asked);

/// A run of a scene in its directory, ready to be driven, and the table that is recorded while it moves.
template <int Dim>
struct SceneRun {
  RunOptions options;
  RunDirectory directory;
  Run<Dim> run;
  std::unique_ptr<MotionTable<Dim>> table;  ///< null: no table is recorded

  /// Begins the run or resumes it.
  /// @throws InputError for a scene that cannot be run, or a directory that holds another run or, unless resume or
  /// overwrite is set, this one
  SceneRun(const Scene& scene, const SceneRunOptions& asked);

  /// Drives the run. @param watch  functions that are notified of its progress; the other options follow from the
  /// arguments of the constructor
  [[nodiscard]] DriveReport drive(DriveOptions<Dim> watch);

 private:
  double checkpoint_every_;
  std::optional<int> until_;
  bool timing_;
};

/// Runs a scene in one call, as `floc run` does: to its end, or until `stop` stops it at a checkpoint. `asked.resume`
/// continues from there.
/// @param scene_file  scene (TOML)  @param changes  "key=value" each, replacing values of the scene
/// @param stop        called between chunks of motion; true stops the run; empty: the run continues to its end
/// @return outcome of the run: report.outcome is done, stopped, or gave_up if an equilibrium was not reached
/// @throws InputError as read_scene() and SceneRun, IoError if the directory cannot be written
[[nodiscard]] DriveReport run_scene(const std::string& scene_file, const SceneRunOptions& asked,
                                    const std::vector<std::string>& changes = {},
                                    const std::function<bool()>& stop = {});

/// Returns the treatment of an existing directory of a run that the options give.
Existing existing_of(const SceneRunOptions& asked);

/// Describes how a run that is not done ended.
template <int Dim>
std::string ending_of(const DriveReport& report, const Run<Dim>& run);

}  // namespace floc
