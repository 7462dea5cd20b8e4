#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Tolerances of an equilibrium: a packing is in equilibrium if its residuals are below them. The tolerances are given
/// in units of the force scale F1 = max(F0, P a^(Dim-1)) and the largest diameter a, where F0 is the pull-off force and
/// P the pressure (docs/physics.md, "Equilibrium"; default values of [GRC2008]). If diameters differ by more than a
/// factor of four, the force, moment and energy of each grain are expressed in units of the scale of this grain
/// (GrainScales).
struct EquilibriumTolerance {
  double force = 1e-5;   ///< largest net force on a grain, in units of the force scale F1
  double moment = 1e-5;  ///< largest net moment on a grain, in units of F1 a (force scale times diameter)
  /// Largest difference between the stress along an axis and the imposed stress, in units of F1/a^(Dim-1), with the
  /// force scale F1 and the largest diameter a.
  double stress = 1e-5;
  double energy = 5e-8;  ///< mean kinetic energy of a grain, in units of F1 a (force scale times diameter)

  bool operator==(const EquilibriumTolerance&) const = default;
};

/// Residuals of a packing, in the units of EquilibriumTolerance: largest net force and largest net moment on a grain,
/// deviation from the imposed stress, and kinetic energy per grain. In exact equilibrium, these residuals are zero. The
/// last two members are the indices of the grains with the largest net force and the largest net moment.
struct Residuals {
  double force = 0.0;
  double moment = 0.0;
  double stress = 0.0;
  double energy = 0.0;
  int worst_force_grain = -1;
  int worst_moment_grain = -1;

  bool within(const EquilibriumTolerance& t) const {
    return force < t.force && moment < t.moment && stress < t.stress && energy < t.energy;
  }
};

/// Units of force and length for the residuals of a packing, or of one grain.
struct ForceScale {
  double force;   ///< force scale F1 (force)
  double length;  ///< largest diameter a of the packing, or diameter of the grain (length)
};

/// Returns the force scale of a packing, F1 = max(F0, P a^(Dim-1)), where F0 is the pull-off force and a the
/// largest diameter.
/// @param target_stress  stress imposed on each axis, compression positive; the pressure P is its mean
template <int Dim>
ForceScale force_scale(const Packing<Dim>& packing, const Vec<Dim>& target_stress);

/// Force scales of the grains of a packing. The force scale of a grain is the unit of the net force on it. Grains of
/// similar sizes (kSimilarSizes) share the force scale F1 of the packing. If sizes differ more, a net force that is
/// small for a large grain may be as large as the contact forces of a small grain. In this case, grain i of diameter
/// d_i has the force scale F1_i = max(F0, P d_i^(Dim-1)) with the pull-off force F0 and the pressure P, and F1_i d_i is
/// the unit of the net moment and of the energy of this grain. The object keeps a reference to the packing.
template <int Dim>
class GrainScales {
 public:
  GrainScales(const Packing<Dim>& packing, const Vec<Dim>& target_stress);

  const ForceScale& of_packing() const { return packing_; }
  ForceScale of(int i) const;       ///< force scale F1_i and diameter d_i of grain i
  double force_share(int i) const;  ///< force scale F1_i of grain i divided by F1 of the packing
  /// Product F1_i d_i of grain i (force scale times diameter), divided by the product F1 a of the packing (force scale
  /// times largest diameter).
  double work_share(int i) const;

 private:
  const std::vector<double>& radius_;
  ForceScale packing_;
  Law law_;
  double pressure_;
  bool shared_;
};

/// Returns the reduced pressure P* (dimensionless): a^(Dim-1) P/F0 with adhesion, P a^(Dim-2)/K_N without adhesion. P
/// is the pressure, a the largest diameter, F0 the pull-off force and K_N the normal stiffness; in general
/// K_N/a^(Dim-2) is Law::contact_modulus() (docs/physics.md, "Units and signs").
/// @param pressure  pressure P (force/length^(Dim-1))
template <int Dim>
double reduced_pressure(const Packing<Dim>& packing, double pressure);

/// Returns a weighted mean of the kinetic energies of the grains (energy). The energy of grain i is divided by F1_i
/// d_i, the force scale times the diameter of this grain (GrainScales). The mean of these ratios is multiplied by F1 a,
/// the force scale times the largest diameter of the packing. If all grains share one scale, the result is the plain
/// mean.
/// @param counted  for each grain, whether its energy is included; if empty, the energies of all grains are included
template <int Dim>
double scaled_kinetic_energy(const Packing<Dim>& packing, const GrainScales<Dim>& scales,
                             const std::vector<bool>& counted = {});

/// Computes the residuals of a packing from the recorded contact forces. If the force scale F1 is zero (no adhesion, no
/// pressure), a residual is either exactly zero or infinite.
/// @param target_stress  stress imposed on each axis, compression positive (force/length^(Dim-1))
template <int Dim>
Residuals residuals(const Packing<Dim>& packing, const Vec<Dim>& target_stress);

/// Computes the residuals of a packing whose static stress is already known.
/// @param stress  static_stress() of the packing
template <int Dim>
Residuals residuals(const Packing<Dim>& packing, const Vec<Dim>& target_stress, const Mat<Dim>& stress);

}  // namespace floc
