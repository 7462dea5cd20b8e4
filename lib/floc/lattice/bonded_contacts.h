#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// A bond as a contact of a packing: the grains that it joins, its forces and its stiffnesses.
template <int Dim>
struct BondedContact {
  int i, j;
  Vec<Dim, int> image;
  double normal_force;         ///< compression positive (force)
  Vec<Dim> shear_force;        ///< on i (force)
  RotationVector<Dim> moment;  ///< moment on i, in 3D rolling and twisting (force * length)
  double kn, kt;               ///< (force/length)
  double kr;            ///< against rolling, and in 3D against twisting where it resists it (force * length)
  bool twists = false;  ///< resists twisting (3D)
};
template <int Dim>
using BondedContacts = std::vector<BondedContact<Dim>>;

/// Gives a packing these contacts and a law under which they can carry their forces: linear springs of the mean
/// stiffness, adhesion of twice the largest tension (bonds are always cohesive), and friction and rolling
/// resistance where bonds resist shear or carry moments, with caps twice as high as any force.
template <int Dim>
void set_bonded_contacts(const BondedContacts<Dim>& bonds, Packing<Dim>& packing);

}  // namespace floc
