#pragma once

#include <memory>
#include <string>

#include "floc/run_directory/motion_table.h"
#include "floc/run_directory/run_directory.h"
#include "floc/structure/energy_account.h"

namespace floc {

/// Records the energy balance of a run in the table DIR/energy.csv, where DIR is the directory of the run. The table
/// has one row per chunk of time steps and one per equilibrium. If the packing is made by aggregation, the balance
/// begins when the grains have aggregated.
///
/// Columns: step (number of the equilibrium), branch (name of the stage), P (imposed pressure), time (since the
/// beginning of the run), phi (solid fraction), then the members of EnergyTerms (unit of energy): work, elastic,
/// kinetic, viscous, sliding, scaling, removed, initial, error (the part of the balance that the other terms do not
/// explain), liquid, law and hysteresis.
template <int Dim>
class EnergyTracker final : public MotionTable<Dim> {
 public:
  /// @param file  file of the table; if it exists, its rows up to the present time of the run are kept
  /// @param start  packing from which on the balance is recorded or continued
  /// @throws InputError if the packing has walls
  EnergyTracker(const std::string& file, const Run<Dim>& run, Packing<Dim> start);

  /// Adds the energies of one time step to the balance.
  /// @param packing  packing after the time step
  /// @param time  time since the beginning of the run
  void record(const Run<Dim>& run, const Packing<Dim>& packing, double time);
  void finish_step(const Run<Dim>& run) override;

 private:
  void add_row_of(const Run<Dim>& run, const Packing<Dim>& packing, double time);

  EnergyAccount<Dim> account_;
  double time_;  ///< time at the end of the last recorded time step, since the beginning of the run
  int n_steps_ = 0;
};

/// Checks that the energy balance of a run can be recorded.
/// @throws InputError if the scene has walls, if equilibria may be found by Newton steps (without motion), or if grains
/// are moved without forces between two equilibria (by a vibration or a simple shear)
void require_energy_account(const RunOptions& options);

/// Starts recording the energy balance of a run in the table energy.csv of its directory while its packing moves.
/// @param options  options of the run
/// @pre the run is not finished; its object is not moved in memory while it is driven
/// @throws InputError if require_energy_account() does
template <int Dim>
std::unique_ptr<EnergyTracker<Dim>> track_energy(Run<Dim>& run, const RunOptions& options,
                                                 const RunDirectory& directory);

}  // namespace floc
