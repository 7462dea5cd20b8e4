#pragma once

#include <memory>
#include <string>

#include "floc/run_directory/motion_table.h"
#include "floc/run_directory/run_directory.h"

namespace floc {

/// Records which contacts open and close inside the steps of a run: DIR/contacts.csv, one row per interval.
///
/// Columns: step, branch, P (that the step goes to), time (since the beginning of the run), phi, n_contacts,
/// gained and lost (since the row before, or the beginning of the step), kept (of the contacts the step began
/// with). The last row of a step is its equilibrium.
template <int Dim>
class ContactTracker final : public MotionTable<Dim> {
 public:
  /// @param file   where the rows go; those of an earlier part of the run, up to its point, are kept
  /// @param start  packing with which the present step began
  ContactTracker(const std::string& file, const Run<Dim>& run, Packing<Dim> start);

  /// Records a packing on its way. @param time  since the beginning of the run
  void record(const Run<Dim>& run, const Packing<Dim>& packing, double time);
  void finish_step(const Run<Dim>& run) override;

 private:
  Packing<Dim> start_, previous_;
};

/// Has the contacts of a run recorded while it moves, in the table of its directory.
/// @param interval  simulated time between two rows (time)
/// @pre the run is not finished, and stays where it is in memory as long as it moves
template <int Dim>
std::unique_ptr<ContactTracker<Dim>> track_contacts(Run<Dim>& run, const RunOptions& options,
                                                    const RunDirectory& directory, double interval);

}  // namespace floc
