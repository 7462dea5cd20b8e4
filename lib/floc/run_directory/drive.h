#pragma once

#include <functional>
#include <limits>

#include "floc/base/range.h"
#include "floc/run_directory/motion_table.h"
#include "floc/run_directory/run_directory.h"

namespace floc {

/// Options for driving a run (computing and saving its equilibria), and functions that are called to report its
/// progress.
template <int Dim>
struct DriveOptions {
  double checkpoint_every = 60.0;               ///< wall time between two checkpoints (s)
  int until = std::numeric_limits<int>::max();  ///< number of the last equilibrium to compute, counted from 0
  static constexpr WholeRange kUntil{.least = 0, .most = std::numeric_limits<int>::max()};
  /// whether path.csv records the wall time of each step; without the wall times, equal runs write equal files
  bool timing = true;
  /// Function that is called after each chunk of time steps, for example to test for a signal. If it returns true, a
  /// checkpoint is written and the run stops. If no function is given, the run does not stop early.
  std::function<bool()> stop;
  /// Function that is called after each chunk of time steps that has not reached an equilibrium. May be empty.
  std::function<void(const Run<Dim>&)> chunk;
  /// Function that is called after an equilibrium has been saved, with the saved state, the report of its relaxation,
  /// and the wall time since the previous equilibrium (s). May be empty.
  std::function<void(const State<Dim>&, const RelaxationReport&, double seconds)> equilibrium;
};

/// Outcome of drive(). Unless the outcome is `done`, the run can be resumed from its checkpoint.
struct DriveReport {
  enum Outcome {
    done,     ///< every equilibrium up to DriveOptions::until is saved
    stopped,  ///< `DriveOptions::stop` returned true
    gave_up,  ///< the packing does not come to equilibrium under the present load
  };
  Outcome outcome = done;
  /// if the outcome is `gave_up`: report of the relaxation that did not converge
  RelaxationReport relaxation;
};

/// Returns the run in a directory, at the point that the run has reached; a new run if the directory contains none.
/// @param options  options with which `directory` was opened
/// @throws InputError if a run with these options is not possible, or if files in the directory cannot be read
template <int Dim>
Run<Dim> start_or_resume(RunDirectory& directory, const RunOptions& options);

/// Drives a run: computes its equilibria and writes the results into its directory, namely a state file and a row of
/// path.csv for each equilibrium, and checkpoints in between.
/// @param table  table contacts.csv or energy.csv, which also records the motion of the packing; null for none
/// @throws InputError if `options.until` is out of its range, IoError if a file cannot be written
template <int Dim>
[[nodiscard]] DriveReport drive(Run<Dim>& run, RunDirectory& directory, const DriveOptions<Dim>& options,
                                MotionTable<Dim>* table = nullptr);

}  // namespace floc
