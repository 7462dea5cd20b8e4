#pragma once

#include "floc/geometry/separation.h"
#include "floc/packing/packing.h"
#include "floc/shape/manifold.h"

/// Geometry of contacts between two bodies (grains or walls). All code computes gaps, normals and lever arms from
/// positions and shapes with these functions. The only exception is the force loop of the dynamics, which computes the
/// same quantities from arrays (relaxation/pair_arrays.h).
namespace floc {

/// Geometry of the contact of two bodies i and j, computed from their positions and shapes.
template <int Dim>
struct ContactGeometry {
  /// Vector from the centre of i to the centre of the image of j, or to the nearest point of a wall (length).
  Vec<Dim> branch;
  Vec<Dim> normal;  ///< unit vector from i to j, zero if their centres coincide
  double gap;       ///< distance between the surfaces (length), negative if they overlap
  Vec<Dim> arm_i;   ///< vector from the centre of i to the contact point (length)
  Vec<Dim> arm_j;   ///< vector from the end of the branch to the contact point (length)
};

/// Returns the geometry of the contact of two balls whose centres are the ends of a branch vector (length).
/// @param radius_j  radius of the second ball; 0 if the branch ends on a wall
template <int Dim>
ContactGeometry<Dim> locate_balls(const DoubleDoubleVec<Dim>& branch, double radius_i, double radius_j);

/// Returns the geometry of a contact of a packing. Only the members i, j, image and key of `contact` are used. The
/// bodies of the contact are two grains, a grain and an image of itself, or a grain and a wall.
template <int Dim>
ContactGeometry<Dim> locate(const Packing<Dim>& packing, const Contact<Dim>& contact);

/// Returns the contact points of the two bodies of a contact. The bodies are two shapes, or a shape and a wall, and at
/// least one of them has corners. Only the members i and j of `contact` are used.
/// @param branch  branch vector of the contact (length)
/// @param reach  largest gap of a contact point (length)
/// @param last  features (such as vertices or faces) with which the search begins, as in contact_manifold()
/// @pre !packing.grains.are_round()
template <int Dim>
Manifold<Dim> manifold_of(const Packing<Dim>& packing, const Contact<Dim>& contact, const Vec<Dim>& branch,
                          double reach, AxisFeatures* last = nullptr);

/// Returns the options with which contact points of two grains of a packing are found.
/// @pre !packing.grains.are_round()
template <int Dim>
ManifoldOptions manifold_options(const Packing<Dim>& packing);

/// Returns whether the grains are rigid polyhedra without friction and adhesion, both between grains and on walls.
/// Their contact forces are normal to the surfaces, so that an error of a normal would unbalance the forces. The
/// contact points are therefore computed with ManifoldOptions::exact.
template <int Dim>
bool are_smooth_polyhedra(const Packing<Dim>& packing);

/// Copies the gap, the normal and the lever arms from `geometry` to a contact.
template <int Dim>
void place(const ContactGeometry<Dim>& geometry, Contact<Dim>& contact);

/// Sets the lever arms of all contacts of a packing of round grains from the positions of the grains. Gaps and normals
/// are not changed.
/// @pre packing.grains.are_round()
template <int Dim>
void set_arms(Packing<Dim>& packing);

}  // namespace floc
