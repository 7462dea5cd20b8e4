#pragma once

#include <memory>
#include <string>

#include "floc/run_directory/motion_table.h"
#include "floc/run_directory/run_directory.h"
#include "floc/structure/energy_account.h"

namespace floc {

/// Records the energy account of a run: DIR/energy.csv, one row per chunk of time steps and per equilibrium, from the
/// end of an aggregation on.
///
/// Columns: step, branch, P (the target of the step), time (since the beginning of the run), phi, then the terms of
/// EnergyTerms (energy): work, elastic, kinetic, viscous, sliding, scaling, removed, initial, error (the sum that the
/// account leaves unexplained), liquid, law and hysteresis.
template <int Dim>
class EnergyTracker final : public MotionTable<Dim> {
 public:
  /// @param file   file of the table
  /// @param start  packing from which the account continues
  /// @throws InputError if the packing has walls
  EnergyTracker(const std::string& file, const Run<Dim>& run, Packing<Dim> start);

  /// Takes in a packing that has moved by one time step. @param time  time since the beginning of the run
  void record(const Run<Dim>& run, const Packing<Dim>& packing, double time);
  void finish_step(const Run<Dim>& run) override;

 private:
  void add_row_of(const Run<Dim>& run, const Packing<Dim>& packing, double time);

  EnergyAccount<Dim> account_;
  double time_;  ///< time of the last time step
  int n_steps_ = 0;
};

/// Checks that the energy account of a run can be recorded.
/// @throws InputError if it cannot: if the grains stand in a box, if equilibria may be found by static steps, to
/// which no motion leads, or if grains are moved by other means between two equilibria
void require_energy_account(const RunOptions& options);

/// Starts recording the energy account of a run while it moves, in the table of its directory.
/// @pre the run is not finished, and is not moved in memory as long as it is driven
/// @throws InputError as require_energy_account()
template <int Dim>
std::unique_ptr<EnergyTracker<Dim>> track_energy(Run<Dim>& run, const RunOptions& options,
                                                 const RunDirectory& directory);

}  // namespace floc
