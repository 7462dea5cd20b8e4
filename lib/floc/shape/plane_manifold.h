#pragma once

#include "floc/shape/manifold.h"

namespace floc {

/// Computes the contact of a shape and a plane, such as a wall. The contact points are the vertices whose gap is
/// smaller than `reach`. The key of a point is the index of its vertex.
/// @param normal  unit normal of the plane, in the direction away from the shape
/// @param offset  value of normal . x on the plane
/// @param reach  largest gap of a contact point (length), >= 0
template <int Dim>
Manifold<Dim> plane_manifold(const PlacedShape<Dim>& shape, const Vec<Dim>& normal, double offset,
                             double reach);

}  // namespace floc
