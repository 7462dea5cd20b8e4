#pragma once

#include <optional>

#include "floc/packing/equilibrium.h"

namespace floc {

/// What finds the equilibrium.
enum class Finish {
  automatic,  ///< Newton steps from the state before where dynamics could end nowhere else; otherwise dynamics until
              ///< motion has stopped, power control, and Newton steps where they succeed
  dynamic,  ///< dynamics and power control only
  statics,  ///< as automatic, but any equilibrium that Newton steps find at once is taken
};

/// Numerical settings of a relaxation. Stresses, rates and masses are in the scene's units unless said.
struct RelaxationOptions {
  EquilibriumTolerance tolerance;
  Finish finish = Finish::automatic;
  /// In sqrt(m_min/K_N). The explicit scheme is unstable from about 0.38 on for friction with K_T = K_N; at the
  /// default the restitution of the largest grains is right to 1 % (0.015, sizes 1:2).
  double time_step = 0.28;
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
  /// How long a packing has to stay as it is before its motion counts as stopped, in units of what the relaxer asks for:
  /// a smaller number saves time, and may end a collapse that only pauses.
  double patience = 1.0;
};

}  // namespace floc
