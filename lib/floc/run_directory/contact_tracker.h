#pragma once

#include <memory>
#include <string>

#include "floc/run_directory/motion_table.h"
#include "floc/run_directory/run_directory.h"

namespace floc {

/// Records the contacts that open and close inside the steps of a run: DIR/contacts.csv, one row per interval.
///
/// Columns: step, branch, P (the target of the step), time (since the beginning of the run), phi, n_contacts, gained
/// and lost (since the previous row, or the beginning of the step), kept (of the contacts at the beginning of the
/// step). The last row of a step is its equilibrium.
template <int Dim>
class ContactTracker final : public MotionTable<Dim> {
 public:
  /// @param file   file of the table; rows of an earlier part of the run, up to its present point, are kept
  /// @param start  packing at the beginning of the present step
  ContactTracker(const std::string& file, const Run<Dim>& run, Packing<Dim> start);

  /// Adds a row for a packing in motion. @param time  time since the beginning of the run
  void record(const Run<Dim>& run, const Packing<Dim>& packing, double time);
  void finish_step(const Run<Dim>& run) override;

 private:
  Packing<Dim> start_, previous_;
};

/// Starts recording the contacts of a run while it moves, in the table of its directory.
/// @param interval  simulated time between two rows (time)
/// @pre the run is not finished, and is not moved in memory as long as it is driven
template <int Dim>
std::unique_ptr<ContactTracker<Dim>> track_contacts(Run<Dim>& run, const RunOptions& options,
                                                    const RunDirectory& directory, double interval);

}  // namespace floc
