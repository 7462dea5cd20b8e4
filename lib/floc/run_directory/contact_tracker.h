#pragma once

#include <memory>
#include <string>

#include "floc/run_directory/motion_table.h"
#include "floc/run_directory/run_directory.h"

namespace floc {

/// Records how contacts open and close while the packing of a run moves, in the table DIR/contacts.csv, where DIR is
/// the directory of the run. The table has one row per interval of simulated time. The last row of each step of the run
/// describes the equilibrium with which the step ends.
///
/// Columns: step (number of the equilibrium), branch (name of the load stage), P (imposed pressure), time (since the
/// beginning of the run), phi (solid fraction), n_contacts, gained (contacts that have closed since the previous row),
/// lost (contacts that have opened since the previous row), kept (contacts that have existed since the beginning of the
/// step). In the first row of a step, gained and lost are counted from the beginning of the step.
template <int Dim>
class ContactTracker final : public MotionTable<Dim> {
 public:
  /// @param file  file of the table; if it exists, its rows up to the present time of the run are kept
  /// @param start  packing at the beginning of the present step of the run
  ContactTracker(const std::string& file, const Run<Dim>& run, Packing<Dim> start);

  /// Adds a row for a moving packing.
  /// @param time  time since the beginning of the run
  void record(const Run<Dim>& run, const Packing<Dim>& packing, double time);
  void finish_step(const Run<Dim>& run) override;

 private:
  Packing<Dim> start_, previous_;
};

/// Starts recording the contacts of a run while the packing moves, in the table contacts.csv in the directory of the
/// run.
/// @param options  options of the run
/// @param interval  simulated time between two rows (time unit of the scene)
/// @pre `run` is not finished, and stays at its address in memory until it has been driven
template <int Dim>
std::unique_ptr<ContactTracker<Dim>> track_contacts(Run<Dim>& run, const RunOptions& options,
                                                    const RunDirectory& directory, double interval);

}  // namespace floc
