#pragma once

#include <functional>
#include <limits>

#include "floc/base/range.h"
#include "floc/run_directory/motion_table.h"
#include "floc/run_directory/run_directory.h"

namespace floc {

/// Options of driving a run, and functions that are notified of its progress.
template <int Dim>
struct DriveOptions {
  double checkpoint_every = 60.0;               ///< wall time between two checkpoints (s)
  int until = std::numeric_limits<int>::max();  ///< number of the last equilibrium to make, in kUntil
  static constexpr WholeRange kUntil{.least = 0, .most = std::numeric_limits<int>::max()};
  bool timing = true;  ///< whether path.csv has the wall time of steps; without it, equal runs give equal files
  /// Called after each chunk of steps, for example to test for a signal; true stops the run at a checkpoint. May be
  /// empty.
  std::function<bool()> stop;
  /// Called after each chunk that ends without an equilibrium. May be empty.
  std::function<void(const Run<Dim>&)> chunk;
  /// Called with each equilibrium once it is saved, with the wall time of its step (s). May be empty.
  std::function<void(const State<Dim>&, const RelaxationReport&, double seconds)> equilibrium;
};

/// Outcome of driving a run. A run that is not done can be resumed from its checkpoint.
struct DriveReport {
  enum Outcome {
    done,     ///< every requested equilibrium is saved
    stopped,  ///< `DriveOptions::stop` returned true
    gave_up,  ///< the present step does not converge
  };
  Outcome outcome = done;
  RelaxationReport relaxation;  ///< report of the step that did not converge
};

/// Returns the run of a directory, at the point that it has reached there or at its beginning.
/// @param options  the options with which the directory was opened
/// @throws InputError for options that cannot be run, or files that cannot be read
template <int Dim>
Run<Dim> start_or_resume(RunDirectory& directory, const RunOptions& options);

/// Drives a run and keeps its directory up to date: a state and a row for each equilibrium, and checkpoints.
/// @param table  table that is recorded while this run moves; null: none
/// @throws InputError for an option out of its range, IoError if a file cannot be written
template <int Dim>
[[nodiscard]] DriveReport drive(Run<Dim>& run, RunDirectory& directory, const DriveOptions<Dim>& options,
                                MotionTable<Dim>* table = nullptr);

}  // namespace floc
