#pragma once

#include <optional>
#include <vector>

#include "floc/shape/polytope.h"

namespace floc {

/// Half-space of the points x with normal . x <= offset.
template <int Dim>
struct HalfSpace {
  Vec<Dim> normal;  ///< normal vector that points out of the half-space, of any length
  /// value of normal . x on the boundary plane, > 0: the origin is inside the half-space
  double offset = 0.0;
};

/// Returns the vertices of the intersection of half-spaces. The vertices are computed from the convex hull of the
/// points normal/offset, which are dual to the half-spaces.
/// @return vertices; no value if the intersection is not bounded, or if a vertex is so far away that rounding errors
/// leave open whether the intersection is bounded
template <int Dim>
std::optional<std::vector<Vec<Dim>>> intersection_vertices(const std::vector<HalfSpace<Dim>>& half_spaces);

}  // namespace floc
