#pragma once

#include <memory>
#include <string>

#include "floc/run_directory/motion_table.h"
#include "floc/run_directory/run_directory.h"

namespace floc {

/// Records how contacts open and close during the steps of a run, in the table DIR/contacts.csv. It has one row per
/// interval of time and one for each equilibrium.
///
/// Columns: step, branch, P (target pressure of the step), time (since the beginning of the run), phi (solid fraction),
/// n_contacts, gained and lost (contacts that opened or closed since the previous row or the beginning of the step),
/// kept (contacts that already existed at the beginning of the step). The last row of a step describes its equilibrium.
template <int Dim>
class ContactTracker final : public MotionTable<Dim> {
 public:
  /// @param file  file of the table; if it exists, its rows up to the present point of the run are kept
  /// @param start  packing at the beginning of the present step of the load path
  ContactTracker(const std::string& file, const Run<Dim>& run, Packing<Dim> start);

  /// Adds a row for a packing in motion.
  /// @param time  time since the beginning of the run
  void record(const Run<Dim>& run, const Packing<Dim>& packing, double time);
  void finish_step(const Run<Dim>& run) override;

 private:
  Packing<Dim> start_, previous_;
};

/// Starts recording the contacts of a run while it moves, in the table contacts.csv of its directory.
/// @param interval  simulated time between two rows (time unit of the scene)
/// @pre the run is not finished, and its object is not moved in memory while it is driven
template <int Dim>
std::unique_ptr<ContactTracker<Dim>> track_contacts(Run<Dim>& run, const RunOptions& options,
                                                    const RunDirectory& directory, double interval);

}  // namespace floc
