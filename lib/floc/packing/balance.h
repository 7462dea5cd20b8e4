#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Net static force and net static moment on every grain.
template <int Dim>
struct Balance {
  std::vector<Vec<Dim>> force;  ///< net force on each grain (force)
  /// Net moment about the centre of each grain: sum of the moments of the tangential forces and of the rolling
  /// and twisting springs (force * length).
  std::vector<RotationVector<Dim>> moment;
};

template <int Dim>
Balance<Dim> net_forces(const Packing<Dim>& packing);

/// Returns the static stress sum F_j^(a) r^(b) / volume over all interactions, compression positive
/// (force/length^(Dim-1)). F_j is the force on the second grain j of an interaction, r the branch vector from
/// grain i to grain j, and `volume` the volume of the cell.
template <int Dim>
Mat<Dim> static_stress(const Packing<Dim>& packing);

/// Returns the stress transmitted by the interactions that cross the faces of the cell: sum F_j^(a) (image *
/// cell.matrix)^(b) / volume, where F_j is the force on the second grain j. It is the force across each face
/// divided by the area of the face (force/length^(Dim-1)). It differs from static_stress() by the moments of
/// the net forces F_i of the grains at x_i, sum F_i^(a) x_i^(b) / volume, which vanish in equilibrium.
template <int Dim>
Mat<Dim> boundary_stress(const Packing<Dim>& packing);

/// Returns twice the kinetic energy of a grain: of its peculiar velocity and its spin (energy).
template <int Dim>
double twice_kinetic_energy(const Grains<Dim>& grains, int i);

/// Returns the mean kinetic energy of a grain: of its peculiar velocity and its spin (energy).
template <int Dim>
double mean_kinetic_energy(const Packing<Dim>& packing);

}  // namespace floc
