#pragma once

#include "floc/geometry/separation.h"
#include "floc/packing/packing.h"

/// Where two bodies touch. Nothing else in the program derives a gap, a normal or a lever arm from the places and
/// the shapes of grains, but for the force loop, which does the same with arrays (relaxation/pair_arrays.h).
namespace floc {

/// All that the places and the shapes of two bodies say of their contact.
template <int Dim>
struct ContactGeometry {
  Vec<Dim> branch;  ///< from the centre of i to that of the image of j, or to the foot of i's centre on a wall
  Vec<Dim> normal;  ///< unit vector from i to j, zero where their centres coincide
  double gap;       ///< distance between the surfaces (length), < 0: overlap
  Vec<Dim> arm_i;   ///< from the centre of i to the contact point (length)
  Vec<Dim> arm_j;   ///< from the end of the branch to the contact point (length)
};

/// Of two balls at the ends of a branch. @param radius_j  0: the branch ends on a wall
template <int Dim>
ContactGeometry<Dim> locate_balls(const DoubleDoubleVec<Dim>& branch, double radius_i, double radius_j);

/// Of the bodies of a contact, of which i, j, image and key are read: two grains, a grain and the image of another
/// one or of its own, or a grain and a wall.
template <int Dim>
ContactGeometry<Dim> locate(const Packing<Dim>& packing, const Contact<Dim>& contact);

/// Gives a contact its place: gap, normal and arms.
template <int Dim>
void place(const ContactGeometry<Dim>& geometry, Contact<Dim>& contact);

/// Gives all contacts of a packing, whose gaps and normals are kept as they are, their arms.
template <int Dim>
void set_arms(Packing<Dim>& packing);

}  // namespace floc
