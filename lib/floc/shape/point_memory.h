#pragma once

#include <array>
#include <span>

#include "floc/shape/manifold.h"

namespace floc {

/// For each point of a contact the point of the step before whose memory it takes over, or -1.
template <int Dim>
using PointMatches = std::array<int, Manifold<Dim>::kMostPoints>;

/// Matches points of one pair from step to step: first those of equal keys, then each of the others to the
/// nearest point of the step before that none has claimed, the nearest pairs first.
///
/// @param now, before  at most kMostPoints each; arms from the centre of the same body
/// @param radius  distance up to which points without a key in common match: 0.25 of the smaller outer radius
template <int Dim>
PointMatches<Dim> matched_points(std::span<const ManifoldPoint<Dim>> now,
                                 std::span<const ManifoldPoint<Dim>> before, double radius);

}  // namespace floc
