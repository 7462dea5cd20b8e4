#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Net static force and moment on every grain.
template <int Dim>
struct Balance {
  std::vector<Vec<Dim>> force;              ///< (force)
  std::vector<RotationVector<Dim>> moment;  ///< about the centre: sum l F_T + sum Gamma (force * length)
};

template <int Dim>
Balance<Dim> net_forces(const Packing<Dim>& packing);

/// Static stress sum F_j^(a) r^(b) / volume over all interactions, compression positive (force/length^(Dim-1)).
template <int Dim>
Mat<Dim> static_stress(const Packing<Dim>& packing);

/// Stress that the interactions crossing the faces of the cell transmit: sum F_j^(a) (image *
/// cell.matrix)^(b) / volume, which is the force across each face over its area (force/length^(Dim-1)). It
/// differs from static_stress() by the moments of the net forces of the grains, sum F_i^(a) x_i^(b) / volume,
/// which vanish in equilibrium.
template <int Dim>
Mat<Dim> boundary_stress(const Packing<Dim>& packing);

/// Twice the kinetic energy of the peculiar velocity and the spin of a grain (energy).
template <int Dim>
double twice_kinetic_energy(const Grains<Dim>& grains, int i);

/// Kinetic energy of peculiar velocities and spins, mean over the grains (energy).
template <int Dim>
double mean_kinetic_energy(const Packing<Dim>& packing);

}  // namespace floc
