#pragma once

#include "floc/shape/manifold.h"

namespace floc {

/// Computes the contact of a shape and a plane, such as a wall. The contact points are the vertices whose gap is
/// smaller than `reach`. If there are more points than Manifold::kMostPoints, only these are kept: the deepest point,
/// the point furthest from it, and, on each side of the line through these two points, the point furthest from the
/// line. The key of a point is the index of its vertex.
/// @param normal  unit normal of the plane, in the direction away from the shape
/// @param offset  value of normal . x on the plane
/// @param reach  largest gap of a contact point (length), >= 0
/// @param wanted  key of a point that is kept in any case if it is within reach
template <int Dim>
Manifold<Dim> plane_manifold(const PlacedShape<Dim>& shape, const Vec<Dim>& normal, double offset, double reach,
                             std::optional<std::uint32_t> wanted = std::nullopt);

}  // namespace floc
