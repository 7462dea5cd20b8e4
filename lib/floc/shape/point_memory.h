#pragma once

#include <array>
#include <span>

#include "floc/shape/manifold.h"

namespace floc {

/// For each contact point, the index of the matching contact point of the previous step; -1 if no point matches. The
/// history of the matching point is kept.
template <int Dim>
using PointMatches = std::array<int, Manifold<Dim>::kMostPoints>;

/// Matches the contact points of a pair of shapes with the contact points of the previous step. Points with equal keys
/// are matched first. Then each remaining point is matched with the nearest remaining point of the previous step, pairs
/// with the smallest distance first.
///
/// @param now, before  contact points of this step and of the previous step, at most Manifold::kMostPoints each; all arms begin
/// at the centre of the same body
/// @param radius  largest distance at which points with different keys are matched (length): 0.25 of the smaller outer
/// radius of the two shapes
template <int Dim>
PointMatches<Dim> matched_points(std::span<const ManifoldPoint<Dim>> now,
                                 std::span<const ManifoldPoint<Dim>> before, double radius);

}  // namespace floc
