#pragma once

#include <functional>
#include <limits>

#include "floc/base/range.h"
#include "floc/run_directory/motion_table.h"
#include "floc/run_directory/run_directory.h"

namespace floc {

/// How a run is driven, and what is notified of its progress.
template <int Dim>
struct DriveOptions {
  double checkpoint_every = 60.0;               ///< wall time between two checkpoints (s)
  int until = std::numeric_limits<int>::max();  ///< number of the last equilibrium to make, in kUntil
  static constexpr WholeRange kUntil{.least = 0, .most = std::numeric_limits<int>::max()};
  bool timing = true;  ///< whether path.csv says how long each step took; without, equal runs are equal files
  /// Asked after each chunk of steps, such as for a signal: true stops the run at a checkpoint. Empty: never.
  std::function<bool()> stop;
  /// Called after each chunk that ends without an equilibrium. May be empty.
  std::function<void(const Run<Dim>&)> chunk;
  /// Called with each equilibrium once it is saved, with the wall time of its step (s). May be empty.
  std::function<void(const State<Dim>&, const RelaxationReport&, double seconds)> equilibrium;
};

/// Outcome of driving a run. A run that is not done can be resumed from its checkpoint.
struct DriveReport {
  enum Outcome {
    done,     ///< every equilibrium that was asked for is saved
    stopped,  ///< as `DriveOptions::stop` asked
    gave_up,  ///< the present step does not converge
  };
  Outcome outcome = done;
  RelaxationReport relaxation;  ///< of the step that gave up
};

/// The run of a directory: from the point it has reached there, or from its beginning.
/// @param options  those the directory was opened with
/// @throws InputError for options that cannot be run, or files that cannot be read
template <int Dim>
Run<Dim> start_or_resume(RunDirectory& directory, const RunOptions& options);

/// Drives a run and keeps its directory up to date: a state and a row for each equilibrium, and checkpoints.
/// @param table  of what is recorded while this run moves; null: nothing is
/// @throws InputError for an option out of its range, IoError if a file cannot be written
template <int Dim>
[[nodiscard]] DriveReport drive(Run<Dim>& run, RunDirectory& directory, const DriveOptions<Dim>& options,
                                MotionTable<Dim>* table = nullptr);

}  // namespace floc
