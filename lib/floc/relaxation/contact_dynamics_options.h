#pragma once

#include <array>
#include <optional>

namespace floc {

/// Choice of the recorded forces in a packing of rigid grains at rest. In general, many sets of forces balance the
/// grains.
enum class RigidForces {
  closest,    ///< the balanced forces that are closest to the forces of the last time step
  canonical,  ///< the balanced forces with the least elastic energy, which do not depend on the history
  stepped,    ///< the forces of the last time step
};

/// Keywords for RigidForces in scenes (input files), in the order of the enumerators.
inline constexpr std::array kRigidForcesKeywords = {"closest", "canonical", "none"};

/// Numerical settings of contact dynamics, the implicit time integration of rigid grains (docs/numerics.md).
struct ContactDynamicsOptions {
  /// Longest time step in units of T = sqrt(m/(P a^(Dim-2))), with the mass m and the diameter a of the largest grain
  /// and the pressure P. A step in which a grain would move too far is halved, repeatedly if necessary.
  double time_step = 0.05;
  /// Tolerance of the impulses of a time step, divided by the mean normal impulse: the sweeps over the contacts end
  /// when the error is below this tolerance.
  double sweep_tolerance = 1e-3;
  /// Largest number of sweeps over the contacts in a time step. If the error is still above the tolerance after this
  /// number of sweeps, the step counts as unfinished.
  int max_sweeps = 2000;
  /// Rate of imposed strains in units of 1/T: the largest rate |L'/L| of a length L or, in a shear, the rate of the
  /// shear strain.
  double inertial_number = 1e-2;
  double restitution = 0.0;  ///< coefficient of restitution of normal impacts, from 0 to 1
  RigidForces forces = RigidForces::closest;
  /// Largest gap or overlap, divided by the diameter of the smaller grain, that a contact with a force may have in
  /// equilibrium. If absent: 1e-4 for disks and spheres, 1e-3 for grains with corners.
  std::optional<double> gap_tolerance;
};

}  // namespace floc
