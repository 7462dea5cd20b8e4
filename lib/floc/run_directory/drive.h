#pragma once

#include <functional>
#include <limits>

#include "floc/base/range.h"
#include "floc/run_directory/motion_table.h"
#include "floc/run_directory/run_directory.h"

namespace floc {

/// Options for driving a run, and functions that are called to report its progress.
template <int Dim>
struct DriveOptions {
  double checkpoint_every = 60.0;               ///< wall time between two checkpoints (s)
  int until = std::numeric_limits<int>::max();  ///< number of the last equilibrium to compute, within kUntil
  static constexpr WholeRange kUntil{.least = 0, .most = std::numeric_limits<int>::max()};
  bool timing = true;  ///< whether path.csv has the wall time of steps; without it, equal runs give equal files
  /// Function that is called after each chunk of time steps, for example to test for a signal. If it returns true, a
  /// checkpoint is written and the run stops. May be empty.
  std::function<bool()> stop;
  /// Function that is called after each chunk of time steps that ends without an equilibrium. May be empty.
  std::function<void(const Run<Dim>&)> chunk;
  /// Function that is called with each equilibrium after it has been saved, and with the wall time of its step (s). May
  /// be empty.
  std::function<void(const State<Dim>&, const RelaxationReport&, double seconds)> equilibrium;
};

/// Outcome of driving a run. A run that is not done can be resumed from its checkpoint.
struct DriveReport {
  enum Outcome {
    done,     ///< every requested equilibrium is saved
    stopped,  ///< `DriveOptions::stop` returned true
    gave_up,  ///< the present step of the load path does not converge to an equilibrium
  };
  Outcome outcome = done;
  RelaxationReport relaxation;  ///< report of the step that did not converge
};

/// Returns the run of a directory, at the point that it has reached there, or a new run if the directory is empty.
/// @param options  the options with which the directory was opened
/// @throws InputError if the options are invalid for a run, or if files of the directory cannot be read
template <int Dim>
Run<Dim> start_or_resume(RunDirectory& directory, const RunOptions& options);

/// Drives a run and writes its results into its directory: a state file and a row of path.csv for each equilibrium, and
/// checkpoints.
/// @param table  further table that is recorded while this run moves; null for none
/// @throws InputError if an option is out of its range, IoError if a file cannot be written
template <int Dim>
[[nodiscard]] DriveReport drive(Run<Dim>& run, RunDirectory& directory, const DriveOptions<Dim>& options,
                                MotionTable<Dim>* table = nullptr);

}  // namespace floc
