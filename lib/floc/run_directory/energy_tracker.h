#pragma once

#include <memory>
#include <string>

#include "floc/run_directory/motion_table.h"
#include "floc/run_directory/run_directory.h"
#include "floc/structure/energy_account.h"

namespace floc {

/// Records the energy balance of a run in the table DIR/energy.csv. It has one row per chunk of time steps and one per
/// equilibrium; if the packing is made by aggregation, it begins at the end of the aggregation.
///
/// Columns: step, branch, P (target pressure of the step), time (since the beginning of the run), phi (solid fraction),
/// then the terms of EnergyTerms (unit of energy): work, elastic, kinetic, viscous, sliding, scaling, removed, initial,
/// error (the sum that the other terms leave unexplained), liquid, law and hysteresis.
template <int Dim>
class EnergyTracker final : public MotionTable<Dim> {
 public:
  /// @param file  file of the table
  /// @param start  packing at which the energy balance continues
  /// @throws InputError if the packing has walls
  EnergyTracker(const std::string& file, const Run<Dim>& run, Packing<Dim> start);

  /// Adds one time step to the energy balance.
  /// @param packing  packing after the time step
  /// @param time  time since the beginning of the run
  void record(const Run<Dim>& run, const Packing<Dim>& packing, double time);
  void finish_step(const Run<Dim>& run) override;

 private:
  void add_row_of(const Run<Dim>& run, const Packing<Dim>& packing, double time);

  EnergyAccount<Dim> account_;
  double time_;  ///< time at the end of the last recorded time step
  int n_steps_ = 0;
};

/// Checks that the energy balance of a run can be recorded.
/// @throws InputError if it cannot: if the scene has walls, if equilibria may be found by Newton steps, which do not
/// follow the motion, or if the grains are moved by other means between two equilibria
void require_energy_account(const RunOptions& options);

/// Starts recording the energy balance of a run while it moves, in the table energy.csv of its directory.
/// @pre the run is not finished, and its object is not moved in memory while it is driven
/// @throws InputError if require_energy_account() does
template <int Dim>
std::unique_ptr<EnergyTracker<Dim>> track_energy(Run<Dim>& run, const RunOptions& options,
                                                 const RunDirectory& directory);

}  // namespace floc
