#pragma once

#include <optional>
#include <vector>

#include "floc/shape/polytope.h"

namespace floc {

/// Half-space normal . x <= offset.
template <int Dim>
struct HalfSpace {
  Vec<Dim> normal;      ///< normal vector that points out of the half-space, of any length
  double offset = 0.0;  ///< offset > 0, so that the origin is inside
};

/// Returns the vertices of the intersection of half-spaces, from the convex hull of the dual points normal /
/// offset.
/// @return nothing if the intersection is not bounded, or is bounded only by faces so far away that they cannot
/// be distinguished from no faces
template <int Dim>
std::optional<std::vector<Vec<Dim>>> intersection_vertices(const std::vector<HalfSpace<Dim>>& half_spaces);

}  // namespace floc
