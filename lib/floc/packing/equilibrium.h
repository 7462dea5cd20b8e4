#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Tolerances of an equilibrium. Each number multiplies the force scale F1 = max(F0, P a^(Dim-1)) and the
/// matching power of the length a, the largest diameter (docs/physics.md, "Equilibrium"; defaults of
/// [GRC2008]). Where diameters differ by more than a factor of four, the forces, moment and energy of each
/// grain are measured by its own scale: see GrainScales.
struct EquilibriumTolerance {
  double force = 1e-5;   ///< net force on any grain / F1 of the grain
  double moment = 1e-5;  ///< net moment on any grain / (F1 a) of the grain
  double stress = 1e-5;  ///< |sigma_aa - Sigma_aa| / (F1/a^(Dim-1))
  double energy = 5e-8;  ///< mean over the grains of kinetic energy / (F1 a) of the grain

  bool operator==(const EquilibriumTolerance&) const = default;
};

/// Residuals of an equilibrium: net force, net moment, stress and kinetic energy in the units of
/// EquilibriumTolerance, with the grains of the largest net force and moment.
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

/// Units of the residuals of a packing or of a grain.
struct ForceScale {
  double force;   ///< F1
  double length;  ///< a, the largest diameter
};

/// Force scale of a packing, F1 = max(F0, P a^(Dim-1)).
/// @param target_stress  stress on each axis, compression positive; P is its mean
template <int Dim>
ForceScale force_scale(const Packing<Dim>& packing, const Vec<Dim>& target_stress);

/// Force scale of each grain. Grains of similar sizes (kSimilarSizes) share the scale of the packing. If sizes
/// differ more, a net force that is small for a large grain may be as large as the contact forces of a small
/// one. The scales of grain i of diameter d_i are then F1_i = max(F0, P d_i^(Dim-1)) for its force and F1_i d_i
/// for its moment and energy. An object refers to the packing that it was made from.
template <int Dim>
class GrainScales {
 public:
  GrainScales(const Packing<Dim>& packing, const Vec<Dim>& target_stress);

  const ForceScale& of_packing() const { return packing_; }
  ForceScale of(int i) const;       ///< F1_i and d_i
  double force_share(int i) const;  ///< F1_i/F1
  double work_share(int i) const;   ///< F1_i d_i/(F1 a)

 private:
  const std::vector<double>& radius_;
  ForceScale packing_;
  Law law_;
  double pressure_;
  bool shared_;
};

/// Reduced pressure P* = a^(Dim-1) P/F0 with adhesion, P a^(Dim-2)/K_N without (dimensionless; docs/physics.md,
/// "Units and signs").
/// @param pressure  P (force/length^(Dim-1))
template <int Dim>
double reduced_pressure(const Packing<Dim>& packing, double pressure);

/// Kinetic energy of each grain in units of its own work scale, averaged over the grains, times F1 a of the
/// packing (energy). It is the plain mean where all grains share one scale.
/// @param counted  whether the energy of each grain counts; empty: all count
template <int Dim>
double scaled_kinetic_energy(const Packing<Dim>& packing, const GrainScales<Dim>& scales,
                             const std::vector<bool>& counted = {});

/// Measures a packing against the diagonal stress it is loaded with, from the forces in its contact list.
/// With an F1 of zero (no adhesion, no pressure), any residual that is not exactly zero is infinite.
template <int Dim>
Residuals residuals(const Packing<Dim>& packing, const Vec<Dim>& target_stress);

/// Measures a packing as above, with its stress given.
/// @param stress  static_stress() of the packing
template <int Dim>
Residuals residuals(const Packing<Dim>& packing, const Vec<Dim>& target_stress, const Mat<Dim>& stress);

}  // namespace floc
