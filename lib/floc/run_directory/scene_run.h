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

/// Where and how a scene is run.
struct SceneRunOptions {
  std::string directory;
  std::optional<std::uint64_t> seed;     ///< replaces that of the scene
  std::optional<int> threads;            ///< replaces that of the scene
  std::optional<int> until;              ///< equilibrium after which the run stops
  std::optional<double> track_contacts;  ///< time between two rows
  bool track_energy = false;
  bool resume = false;
  bool overwrite = false;
  bool no_timing = false;
};

/// Options of the run of a scene, with no more threads than are useful (useful_threads()).
/// @throws InputError for what no run of the scene can do, before anything is written
RunOptions checked_options(const Scene& scene, const SceneRunOptions& asked);

/// The threads that the run leaves unused and why, in words; empty where it uses all that are asked for.
std::string unused_threads(const Scene& scene, const SceneRunOptions& asked);

/// A run of a scene in its directory, ready to be driven, and what is recorded of it while it moves.
template <int Dim>
struct SceneRun {
  RunOptions options;
  RunDirectory directory;
  Run<Dim> run;
  std::unique_ptr<MotionTable<Dim>> table;  ///< null: nothing is

  /// Begins the run or takes it up.
  /// @throws InputError for a scene that cannot be run, or a directory that holds another run or, unless it is to be
  /// resumed or overwritten, this one
  SceneRun(const Scene& scene, const SceneRunOptions& asked);

  /// Drives it. @param watch  who is told of its progress; the rest of the options follows from the arguments
  [[nodiscard]] DriveReport drive(DriveOptions<Dim> watch);

 private:
  double checkpoint_every_;
  std::optional<int> until_;
  bool timing_;
};

/// Runs a scene in one call, as `floc run` does: to its end, or to where `stop` stops it at a checkpoint, from
/// which `asked.resume` goes on.
/// @param scene_file  TOML  @param changes  "key=value", each replaces one of the scene
/// @param stop        asked between chunks of motion whether to stop; none: the run goes on to its end
/// @return how it ended: report.outcome is done, stopped, or gave_up where an equilibrium was not reached
/// @throws InputError as read_scene() and SceneRun, IoError if the directory cannot be written
[[nodiscard]] DriveReport run_scene(const std::string& scene_file, const SceneRunOptions& asked,
                                    const std::vector<std::string>& changes = {},
                                    const std::function<bool()>& stop = {});

/// What there is to do with what the directory of a run holds.
Existing existing_of(const SceneRunOptions& asked);

/// How a run that is not done ended, in words.
template <int Dim>
std::string ending_of(const DriveReport& report, const Run<Dim>& run);

}  // namespace floc
