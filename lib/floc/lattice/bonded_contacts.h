#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Bond in the form of a contact of a packing: the two grains that it joins, its forces and its stiffnesses.
template <int Dim>
struct BondedContact {
  int i, j;
  Vec<Dim, int> image;
  double normal_force;         ///< normal force, compression positive (force)
  Vec<Dim> shear_force;        ///< tangential force on grain i (force)
  RotationVector<Dim> moment;  ///< moment on grain i; in 3D rolling and twisting (force * length)
  double kn, kt;               ///< normal and tangential stiffness (force/length)
  double kr;            ///< rolling stiffness, and in 3D also twisting stiffness if `twists` (force * length)
  bool twists = false;  ///< whether the bond resists twisting (3D)
};
template <int Dim>
using BondedContacts = std::vector<BondedContact<Dim>>;

/// Replaces the contacts of a packing by the given bonds, and its contact law by a law under which they can carry their
/// forces: linear springs of the mean stiffness; adhesion of twice the largest tension (bonds are always cohesive);
/// friction if bonds resist shear, and rolling resistance if they carry moments, with limits twice as high as any
/// force.
template <int Dim>
void set_bonded_contacts(const BondedContacts<Dim>& bonds, Packing<Dim>& packing);

}  // namespace floc
