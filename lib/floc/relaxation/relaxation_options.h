#pragma once

#include <optional>

#include "floc/packing/equilibrium.h"
#include "floc/relaxation/compaction_end.h"

namespace floc {

/// Method by which the equilibrium is found.
enum class Finish {
  /// Newton steps from the previous state where dynamics would end in the same state; otherwise dynamics until
  /// motion has stopped, then power control, and Newton steps where they succeed.
  automatic,
  dynamic,  ///< dynamics and power control only
  statics,  ///< as automatic, but any equilibrium found by the first Newton steps is accepted
};

/// Energy in units of its tolerance up to which a packing counts as at rest where only its mechanisms move.
/// Without load, a packing with soft modes keeps moving at an energy that nothing dissipates, while hardly a
/// contact closes or opens (seen: 70 times the tolerance over 400 time units, 6 of 2200 contacts gained).
inline constexpr double kMechanismEnergy = 100.0;

/// Numerical settings of a relaxation. Stresses, rates and masses are in the scene's units unless stated
/// otherwise.
struct RelaxationOptions {
  EquilibriumTolerance tolerance;
  Finish finish = Finish::automatic;
  /// Time step in sqrt(m_min/K_N). A triangular crystal of equal disks with K_T = K_N is unstable from
  /// 2/sqrt(24) = 0.408 on, whatever its restitution (its rolling modes; other modes are stable up to longer
  /// steps). At the default, a restitution of 0.015 comes out, on average over impacts, as 0.015 for two of the
  /// largest of grains of sizes 1:2, as 0.018 for one of each and as 0.025 for two of the smallest.
  double time_step = 0.36;
  /// Mass M of the cell's sides over the total mass of the grains. It influences the density of assembled
  /// packings.
  double cell_mass = 1.0;
  /// Cap on |L'/L| in units of 1/T0, T0 = sqrt(a m/F0) (cohesive scenes).
  std::optional<double> strain_rate_cap;
  /// Cap on |L'/L| sqrt(m/P) (cohesionless scenes).
  std::optional<double> inertial_number_cap;
  /// Skin of the Verlet list in units of the largest diameter; adapted to the motion when absent.
  std::optional<double> skin;
  /// Longest relaxation, in time units sqrt(a m/F1); beyond it a relaxation is given up. The slowest seen
  /// without load took 1600.
  double max_time = 1e4;
  int threads = 1;
  /// Factor of the times for which a packing has to be steady before its motion counts as stopped. A smaller
  /// factor saves time, but a collapse that only pauses may count as ended.
  double patience = 1.0;
  CompactionEnd compaction;  ///< end of the compaction of packings between walls
};

}  // namespace floc
