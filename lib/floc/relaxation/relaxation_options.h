#pragma once

#include <optional>

#include "floc/packing/equilibrium.h"
#include "floc/relaxation/compaction_end.h"
#include "floc/relaxation/contact_dynamics_options.h"

namespace floc {

/// Method by which a relaxation finds the equilibrium.
enum class Finish {
  /// Newton steps from the previous state, if dynamics (time integration of the motion) would end in the state that the
  /// Newton steps find. Otherwise dynamics until motion has stopped, then power control (Motion::power_control), and
  /// Newton steps where they succeed.
  automatic,
  dynamic,  ///< time integration of the motion and power control only, without Newton steps
  /// Like `automatic`, but an equilibrium that the first Newton steps find is always accepted, even if dynamics would
  /// end in another state.
  statics,
};

/// If only the mechanisms (motions without stiffness) of a packing move, the packing counts as being at rest as long as
/// its kinetic energy is at most this multiple of the tolerance. Without load, soft modes of a packing keep moving,
/// since hardly any contact closes or opens and nothing dissipates the energy. In an observed case the energy was 70
/// times the tolerance, and only 6 contacts were added to 2200 in 400 time units.
inline constexpr double kMechanismEnergy = 100.0;

/// Upper limits of RelaxationOptions::time_step: of any grains, and of grains without friction and without resistance to
/// rolling and twisting. The limit of the latter is that of a crystal without damping, which is 2/sqrt(6) = 0.816 in 2D
/// and 0.913 in 3D; with damping the limit is smaller.
inline constexpr double kStableStep = 0.4;
inline constexpr double kStableStepWithoutFriction = 0.8;

/// Numerical settings of a relaxation. Stresses, rates and masses are in the units of the scene (input file of the
/// run), unless another unit is given.
struct RelaxationOptions {
  EquilibriumTolerance tolerance;
  Finish finish = Finish::automatic;
  /// Time step in units of sqrt(m_min/K_N), with m_min the smallest mass of a grain and K_N the normal stiffness. The
  /// upper limit is 2/sqrt(24) = 0.408: with longer steps, the rolling modes of a triangular crystal of equal disks
  /// with the tangential stiffness K_N are unstable at any restitution. All other modes are stable up to longer steps.
  /// The time step changes the restitution of impacts. For example, with the default time step and diameters from 1 to
  /// 2, the mean restitution of two of the largest grains is the nominal 0.015, that of a largest and a smallest grain
  /// is 0.018, and that of two of the smallest grains is 0.025.
  double time_step = 0.36;
  /// Inertia M of each side of the cell that a stress accelerates, divided by the total mass of the grains. This
  /// inertia influences the density of assembled packings.
  double cell_mass = 1.0;
  /// Cap on the strain rate |L'/L| of the cell in scenes with adhesion, in units of 1/T0. Here L is a side of the cell,
  /// and T0 = sqrt(a m/F0) with the largest diameter a, the largest mass m and the pull-off force F0.
  std::optional<double> strain_rate_cap;
  /// Cap on the inertial number |L'/L| sqrt(m/(P a^(Dim-2))) of the cell in scenes without adhesion, with a side L of
  /// the cell, the largest mass m, the pressure P and the largest diameter a.
  std::optional<double> inertial_number_cap;
  /// Skin of the Verlet lists (lists of neighbouring pairs): extra distance up to which pairs are listed, in units of
  /// the largest diameter. If absent, the skin is adapted to the motion.
  std::optional<double> skin;
  /// Longest duration of a relaxation, in time units sqrt(a m/F1) with the largest diameter a, the largest mass m and
  /// the force scale F1. A longer relaxation is given up. The slowest relaxation seen without load took 1600 time
  /// units.
  double max_time = 1e4;
  int threads = 1;
  /// Factor that multiplies the durations for which a packing has to be steady before its motion counts as stopped. A
  /// smaller factor saves time, but a mere pause in a collapse may then count as its end.
  double patience = 1.0;
  /// Factor by which the stiffness of the contact springs is reduced while the grains rearrange, >= 1 (SoftRelaxer). In
  /// every equilibrium, the springs have the stiffness of the contact law again.
  double softening = 1.0;
  /// Whether each grain moves with the mass of the heaviest one (Run). The time step is then no longer limited by the
  /// smallest grains. No equilibrium depends on masses, except under gravity.
  bool equal_masses = false;
  ContactDynamicsOptions contact_dynamics;  ///< settings for rigid contacts
  CompactionEnd compaction;                 ///< criterion that ends the compaction of a packing between walls
};

}  // namespace floc
