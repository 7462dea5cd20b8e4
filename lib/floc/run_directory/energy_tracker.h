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
/// Columns: step (number of the equilibrium), branch (name of the load stage), P (imposed pressure), time (since the
/// beginning of the run), phi (solid fraction), then the energies that EnergyTerms describes: work, elastic, kinetic,
/// viscous, sliding, scaling, removed, initial, error (the part of the balance that the other energies do not explain),
/// liquid, law and hysteresis.
template <int Dim>
class EnergyTracker final : public MotionTable<Dim> {
 public:
  /// @param file  file of the table; if it exists, its rows up to the present time of the run are kept
  /// @param start  packing at which the balance begins or, in a resumed run, continues
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
  double time_;  ///< time since the beginning of the run, at the end of the last recorded time step
  int n_steps_ = 0;
};

/// Checks that the energy balance of a run can be recorded.
/// @throws InputError if the scene has walls; if Newton's method may find the equilibria without motion of the grains;
/// or if the scene contains a vibration or a simple shear, both of which displace grains without forces
void require_energy_account(const RunOptions& options);

/// Starts recording the energy balance of a run while the packing moves, in the table energy.csv in the directory of
/// the run.
/// @param options  options of the run
/// @pre `run` is not finished, and stays at its address in memory until it has been driven
/// @throws InputError if require_energy_account() refuses `options`
template <int Dim>
std::unique_ptr<EnergyTracker<Dim>> track_energy(Run<Dim>& run, const RunOptions& options,
                                                 const RunDirectory& directory);

}  // namespace floc
