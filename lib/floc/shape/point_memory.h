#pragma once

#include <array>
#include <span>

#include "floc/shape/manifold.h"

namespace floc {

/// For each contact point, the index of the point of the previous step whose history it takes over, or -1.
template <int Dim>
using PointMatches = std::array<int, Manifold<Dim>::kMostPoints>;

/// Matches the contact points of a pair of shapes with those of the previous step. Points with equal keys are
/// matched first. Each other point is then matched with the nearest point of the previous step that is not
/// matched yet, in the order of increasing distance.
///
/// @param now, before  contact points of this step and of the previous one, at most kMostPoints each; their
/// arms begin at the centre of the same body
/// @param radius  largest distance of points with different keys that match: 0.25 of the smaller outer radius
template <int Dim>
PointMatches<Dim> matched_points(std::span<const ManifoldPoint<Dim>> now,
                                 std::span<const ManifoldPoint<Dim>> before, double radius);

}  // namespace floc
