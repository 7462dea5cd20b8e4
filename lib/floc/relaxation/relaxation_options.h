#pragma once

#include <optional>

#include "floc/packing/equilibrium.h"
#include "floc/relaxation/compaction_end.h"

namespace floc {

/// How the equilibrium is found.
enum class Finish {
  /// Newton steps from the previous state where dynamics could end nowhere else; otherwise dynamics until
  /// motion has stopped, power control, and Newton steps where they succeed.
  automatic,
  dynamic,  ///< dynamics and power control only
  statics,  ///< as automatic, but any equilibrium that Newton steps find at once is taken
};

/// Without load, a packing with soft modes only_mechanisms_move at an energy that nothing dissipates while hardly a contact
/// closes or opens (seen: 70 times the tolerance over 400 time units, 6 of 2200 contacts gained): up to this
/// many tolerances of the energy then still count as rest.
inline constexpr double kMechanismEnergy = 100.0;

/// Numerical settings of a relaxation. Stresses, rates and masses are in the scene's units unless said.
struct RelaxationOptions {
  EquilibriumTolerance tolerance;
  Finish finish = Finish::automatic;
  /// In sqrt(m_min/K_N). A triangular crystal of equal disks with K_T = K_N is unstable from 2/sqrt(24) = 0.408
  /// on, whatever its restitution (its rolling modes; others are stable to longer steps). At the default, a
  /// restitution of 0.015 comes out, on average over impacts, as 0.015 for two of the largest of grains of
  /// sizes 1:2, as 0.018 for one of each and as 0.025 for two of the smallest.
  double time_step = 0.36;
  /// Mass M of the cell's sides over the total mass of the grains. It matters for densities at assembly.
  double cell_mass = 1.0;
  /// Cap on |L'/L| in units of 1/T0, T0 = sqrt(a m/F0) (cohesive scenes).
  std::optional<double> strain_rate_cap;
  /// Cap on |L'/L| sqrt(m/P) (cohesionless scenes).
  std::optional<double> inertial_number_cap;
  /// Skin of the Verlet list in units of the largest diameter; adapted to the motion when absent.
  std::optional<double> skin;
  /// In time units sqrt(a m/F1): a relaxation that takes longer is given up. The slowest seen without
  /// load took 1600.
  double max_time = 1e4;
  int threads = 1;
  /// How long a packing has to stay as it is before its motion counts as stopped, in units of what the relaxer
  /// asks for: a smaller number saves time, but may end a collapse that only pauses.
  double patience = 1.0;
  CompactionEnd compaction;  ///< of packings between walls
};

}  // namespace floc
