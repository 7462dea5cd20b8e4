#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// How strict an equilibrium is asked to be. Each number multiplies the force scale F1 = max(F0, P a^(Dim-1)) and
/// the matching power of the length a, the largest diameter (PHYSICS section 1; defaults of G08).
struct EquilibriumTolerance {
  double force = 1e-5;   ///< net force on any grain / F1
  double moment = 1e-5;  ///< net moment on any grain / (F1 a)
  double stress = 1e-5;  ///< |sigma_aa - Sigma_aa| / (F1/a^(Dim-1))
  double energy = 5e-8;  ///< mean kinetic energy per grain / (F1 a)

  bool operator==(const EquilibriumTolerance&) const = default;
};

/// The four measures of PHYSICS section 1 on static forces, in units of the scales above, and where they are worst.
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

/// Units residuals are measured in.
struct ForceScale {
  double force;   ///< F1
  double length;  ///< a, the largest diameter
};

/// F1 = max(F0, P a^(Dim-1)) for the mean of the target's diagonal P.
template <int Dim>
ForceScale force_scale(const Packing<Dim>& packing, const Vec<Dim>& target_stress);

/// Pressure in units of the contact law: P* = a^(Dim-1) P/F0, and P a^(Dim-2)/K_N where nothing adheres (in 2D P/K_N).
template <int Dim>
double reduced_pressure(const Packing<Dim>& packing, double pressure);

/// Measures a packing against the diagonal stress it is loaded with, from the forces in its contact list.
/// An F1 of zero (no adhesion, no pressure) makes any residual infinite but an exact zero.
template <int Dim>
Residuals residuals(const Packing<Dim>& packing, const Vec<Dim>& target_stress);

}  // namespace floc
