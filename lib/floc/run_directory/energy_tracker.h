#pragma once

#include <memory>
#include <string>

#include "floc/run_directory/motion_table.h"
#include "floc/run_directory/run_directory.h"
#include "floc/structure/energy_account.h"

namespace floc {

/// Records the energy account of a run: DIR/energy.csv, one row per chunk of time steps and per equilibrium,
/// from the end of an aggregation on.
///
/// Columns: step, branch, P (that the step goes to), time (since the beginning of the run), phi, then the terms
/// of EnergyTerms (energy): work, elastic, kinetic, viscous, sliding, scaling, removed, initial, error, what the
/// account leaves open, liquid, law and hysteresis.
template <int Dim>
class EnergyTracker final : public MotionTable<Dim> {
 public:
  /// @param file   where the rows go
  /// @param start  the packing that the account goes on from
  /// @throws InputError if the packing has walls
  EnergyTracker(const std::string& file, const Run<Dim>& run, Packing<Dim> start);

  /// Records a packing one time step further on its way. @param time  since the beginning of the run
  void record(const Run<Dim>& run, const Packing<Dim>& packing, double time);
  void finish_step(const Run<Dim>& run) override;

 private:
  void add_row_of(const Run<Dim>& run, const Packing<Dim>& packing, double time);

  EnergyAccount<Dim> account_;
  double time_;  ///< of the last time step
  int n_steps_ = 0;
};

/// @throws InputError if no account of a run can be kept: if its grains stand in a box, if its equilibria may be found
/// by static steps, to which no motion leads, or if its grains are moved otherwise between two of them
void require_energy_account(const RunOptions& options);

/// Has the energy account of a run kept while it moves, in the table of its directory.
/// @pre the run is not finished, and stays where it is in memory as long as it moves
/// @throws InputError as require_energy_account()
template <int Dim>
std::unique_ptr<EnergyTracker<Dim>> track_energy(Run<Dim>& run, const RunOptions& options,
                                                 const RunDirectory& directory);

}  // namespace floc
