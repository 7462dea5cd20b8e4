#pragma once

#include <span>
#include <vector>

#include "floc/shape/manifold.h"

namespace floc {

/// Matches the contact points of a pair of shapes with the contact points of the previous step. Points with equal keys
/// are matched first. Then each remaining point is matched with the nearest remaining point of the previous step, pairs
/// with the smallest distance first. Returns, for each contact point of this step, the index of the matching point of
/// the previous step; -1 if no point matches.
///
/// @param now, before  contact points of this step and of the previous step; all arms begin at the centre of the same
/// body
/// @param radius  largest distance at which points with different keys are matched (length): 0.25 of the smaller outer
/// radius of the two shapes
template <int Dim>
std::vector<int> matched_points(std::span<const ManifoldPoint<Dim>> now,
                                std::span<const ManifoldPoint<Dim>> before, double radius);

}  // namespace floc
