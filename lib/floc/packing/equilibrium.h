#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Tolerances of an equilibrium. Each number is multiplied by the force scale F1 = max(F0, P a^(Dim-1)) and the
/// appropriate power of the largest diameter a, where F0 is the pull-off force and P the pressure
/// (docs/physics.md, "Equilibrium"; default values of [GRC2008]). If diameters differ by more than a factor of
/// four, the force, moment and energy of each grain are measured in units of its own scale: see GrainScales.
struct EquilibriumTolerance {
  double force = 1e-5;   ///< largest net force on a grain, in units of F1 of the grain
  double moment = 1e-5;  ///< largest net moment on a grain, in units of F1 a of the grain
  double stress = 1e-5;  ///< |sigma_aa - Sigma_aa| of measured and imposed stress, in units of F1/a^(Dim-1)
  double energy = 5e-8;  ///< mean kinetic energy of a grain, in units of F1 a of the grain

  bool operator==(const EquilibriumTolerance&) const = default;
};

/// Residuals of an equilibrium: net force, net moment, deviation of the stress and kinetic energy, in the units
/// of EquilibriumTolerance, with the indices of the grains of the largest net force and the largest net moment.
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

/// Units in which the residuals of a packing or of a grain are measured.
struct ForceScale {
  double force;   ///< force scale F1 (force)
  double length;  ///< largest diameter a of the packing, or diameter of the grain (length)
};

/// Returns the force scale of a packing, F1 = max(F0, P a^(Dim-1)), where F0 is the pull-off force and a the
/// largest diameter.
/// @param target_stress  stress imposed on each axis, compression positive; the pressure P is its mean
template <int Dim>
ForceScale force_scale(const Packing<Dim>& packing, const Vec<Dim>& target_stress);

/// Force scale of each grain of a packing. Grains of similar sizes (kSimilarSizes) share the scale of the
/// packing. If sizes differ more, a net force that is small for a large grain may be as large as the contact
/// forces of a small grain. Grain i of diameter d_i then has the force scale F1_i = max(F0, P d_i^(Dim-1)), and
/// F1_i d_i for its moment and energy. The object keeps a reference to the packing.
template <int Dim>
class GrainScales {
 public:
  GrainScales(const Packing<Dim>& packing, const Vec<Dim>& target_stress);

  const ForceScale& of_packing() const { return packing_; }
  ForceScale of(int i) const;       ///< force scale F1_i and diameter d_i of grain i
  double force_share(int i) const;  ///< force scale F1_i of grain i divided by F1 of the packing
  double work_share(int i) const;   ///< force scale times diameter of grain i, divided by F1 a of the packing

 private:
  const std::vector<double>& radius_;
  ForceScale packing_;
  Law law_;
  double pressure_;
  bool shared_;
};

/// Returns the reduced pressure (dimensionless): P* = a^(Dim-1) P/F0 with adhesion, P a^(Dim-2)/K_N without
/// adhesion, where a is the largest diameter, F0 the pull-off force and K_N the normal stiffness
/// (docs/physics.md, "Units and signs").
/// @param pressure  P (force/length^(Dim-1))
template <int Dim>
double reduced_pressure(const Packing<Dim>& packing, double pressure);

/// Returns the kinetic energy of each grain in units of the force scale times the diameter of this grain,
/// averaged over the grains, times F1 a of the packing (force scale times largest diameter; energy). If all
/// grains share one scale, the result is the plain mean.
/// @param counted  whether the energy of each grain is included; empty: all are included
template <int Dim>
double scaled_kinetic_energy(const Packing<Dim>& packing, const GrainScales<Dim>& scales,
                             const std::vector<bool>& counted = {});

/// Computes the residuals of a packing under the diagonal stress with which it is loaded, from the forces in
/// its list of contacts. If the force scale F1 is zero (no adhesion, no pressure), any residual that is not
/// exactly zero is infinite.
template <int Dim>
Residuals residuals(const Packing<Dim>& packing, const Vec<Dim>& target_stress);

/// Computes the residuals of a packing whose stress is already known.
/// @param stress  static_stress() of the packing
template <int Dim>
Residuals residuals(const Packing<Dim>& packing, const Vec<Dim>& target_stress, const Mat<Dim>& stress);

}  // namespace floc
