#pragma once

#include "floc/geometry/separation.h"
#include "floc/packing/packing.h"

/// Geometry of the contact of two bodies. All code derives gaps, normals and lever arms from positions and
/// shapes here, except the force loop, which does the same with arrays (relaxation/pair_arrays.h).
namespace floc {

/// Geometry of a contact, from the positions and the shapes of two bodies.
template <int Dim>
struct ContactGeometry {
  Vec<Dim>
      branch;  ///< vector from the centre of i to that of the image of j, or to the nearest point of a wall
  Vec<Dim> normal;  ///< unit vector from i to j, zero where their centres coincide
  double gap;       ///< distance between the surfaces (length), < 0: overlap
  Vec<Dim> arm_i;   ///< vector from the centre of i to the contact point (length)
  Vec<Dim> arm_j;   ///< vector from the end of the branch to the contact point (length)
};

/// Locates the contact of two balls at the ends of a branch (length).
/// @param radius_j  radius of the second ball; 0: the branch ends on a wall
template <int Dim>
ContactGeometry<Dim> locate_balls(const DoubleDoubleVec<Dim>& branch, double radius_i, double radius_j);

/// Locates a contact of a packing, of which i, j, image and key are read. Its bodies are two grains, a grain
/// and an image of itself or another grain, or a grain and a wall.
template <int Dim>
ContactGeometry<Dim> locate(const Packing<Dim>& packing, const Contact<Dim>& contact);

/// Sets gap, normal and arms of a contact.
template <int Dim>
void place(const ContactGeometry<Dim>& geometry, Contact<Dim>& contact);

/// Sets the arms of all contacts of a packing. Gaps and normals are not changed.
template <int Dim>
void set_arms(Packing<Dim>& packing);

}  // namespace floc
