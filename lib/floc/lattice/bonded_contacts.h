#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Bond between two grains, with its forces and stiffnesses, in the form of a contact of a packing.
template <int Dim>
struct BondedContact {
  int i, j;
  Vec<Dim, int> image;
  double normal_force;   ///< normal force, compression positive (force)
  Vec<Dim> shear_force;  ///< tangential force on grain i (force)
  /// moment on grain i; in 3D about the tangents (rolling) and the normal (twisting) (force * length)
  RotationVector<Dim> moment;
  double kn, kt;        ///< normal and tangential stiffness (force/length)
  double kr;            ///< rolling stiffness; in 3D, if `twists`, also the twisting stiffness (force * length)
  bool twists = false;  ///< whether the bond resists twisting (3D)
};
template <int Dim>
using BondedContacts = std::vector<BondedContact<Dim>>;

/// Replaces the contacts of a packing by the given bonds. The contact law of the packing is replaced by a law that
/// allows the forces of the bonds:
/// - linear springs, with the mean stiffnesses of the bonds;
/// - adhesion with a pull-off force of twice the largest tension, but at least a tenth of the largest force;
/// - friction if bonds resist shear, and rolling resistance if they also resist rolling; the limits in every bond are
///   at least twice the tangential force and twice the moment.
template <int Dim>
void set_bonded_contacts(const BondedContacts<Dim>& bonds, Packing<Dim>& packing);

}  // namespace floc
