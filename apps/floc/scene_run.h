#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "floc/run/drive.h"
#include "floc/run/motion_table.h"
#include "floc/scene/scene.h"

namespace floc {

/// What `floc run` is asked.
struct RunArguments {
  std::string scene;
  std::string directory;
  std::vector<std::string> overrides;
  std::optional<std::uint64_t> seed;
  std::string seeds;
  int jobs = 1;
  std::optional<int> threads;
  std::optional<int> until;
  std::optional<double> track_contacts;  ///< time between two rows
  bool track_energy = false;
  bool resume = false;
  bool overwrite = false;
  bool no_timing = false;
};

/// Options of the run of a scene, with no more threads than are useful (useful_threads()).
/// @throws InputError for what no run of the scene can do, before anything is written
RunOptions checked_options(const Scene& scene, const RunArguments& arguments);

/// The threads that the run leaves unused and why, in words; empty where it uses all that are asked for.
std::string unused_threads(const Scene& scene, const RunArguments& arguments);

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
  SceneRun(const Scene& scene, const RunArguments& arguments);

  /// Drives it. @param watch  who is told of its progress; the rest of the options follows from the arguments
  [[nodiscard]] DriveReport drive(DriveOptions<Dim> watch);

 private:
  double checkpoint_every_;
  std::optional<int> until_;
  bool timing_;
};

/// What there is to do with what the directory of a run holds.
Existing existing_of(const RunArguments& arguments);

/// How a run that is not done ended, in words.
template <int Dim>
std::string ending_of(const DriveReport& report, const Run<Dim>& run);

}  // namespace floc
