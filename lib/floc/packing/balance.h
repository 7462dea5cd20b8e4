#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Net static force and net static moment on every grain.
template <int Dim>
struct Balance {
  std::vector<Vec<Dim>> force;  ///< net force on each grain (force)
  /// Net moment on each grain about its centre (force * length): moments of the contact forces, plus moments of the
  /// rolling and twisting springs.
  std::vector<RotationVector<Dim>> moment;
};

/// Returns the mean elastic (repulsive) force of the contacts whose elastic force is positive; 0 if there are no such
/// contacts (force).
template <int Dim>
double mean_repulsive_force(const Packing<Dim>& packing);

/// Returns the net force and moment on every grain. They result from the contacts of the grain and, if the packing has
/// gravity, from its weight.
template <int Dim>
Balance<Dim> net_forces(const Packing<Dim>& packing);

/// Returns the static stress of a packing, compression positive (force/length^(Dim-1)). Its component (a, b) is the sum
/// over all contacts of F_j^(a) r^(b), divided by the volume of the cell. F_j is the force on the second body of the
/// contact, and stress_lever() gives r.
template <int Dim>
Mat<Dim> static_stress(const Packing<Dim>& packing);

/// Returns the stress transmitted by the contacts that cross the faces of the cell: the force across each face divided
/// by the area of the face (force/length^(Dim-1)). Its component (a, b) is the sum over these contacts of F_j^(a)
/// s^(b), divided by the volume of the cell. F_j is the force on the second grain j of the contact, and s = image *
/// cell.matrix is the displacement of the periodic image of j that touches i; for a contact with a wall, s is the
/// touched point of the wall. This stress differs from static_stress() by the sum over all grains of F_i^(a) x_i^(b),
/// divided by the volume, where F_i is the net force on the grain at x_i; in equilibrium this sum is zero. Under
/// gravity g, the function adds the sum of -m_i g^(a) x_i^(b) over all grains, divided by the volume, with the mass m_i
/// of grain i. With this term, the two stresses agree in equilibrium under gravity as well.
template <int Dim>
Mat<Dim> boundary_stress(const Packing<Dim>& packing);

/// Returns twice the kinetic energy of grain i (energy). It is computed from the angular velocity and from the peculiar
/// velocity, that is, the velocity without the affine motion of the cell.
template <int Dim>
double twice_kinetic_energy(const Grains<Dim>& grains, int i);

/// Returns the mean kinetic energy of a grain (energy). It is computed from the angular velocities and from the
/// peculiar velocities, that is, the velocities without the affine motion of the cell.
template <int Dim>
double mean_kinetic_energy(const Packing<Dim>& packing);

}  // namespace floc
