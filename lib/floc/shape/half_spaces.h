#pragma once

#include <optional>
#include <vector>

#include "floc/shape/polytope.h"

namespace floc {

/// Half-space normal . x <= offset.
template <int Dim>
struct HalfSpace {
  Vec<Dim> normal;      ///< normal out of the half-space, of any length
  double offset = 0.0;  ///< > 0: the origin is inside
};

/// Vertices of the intersection of half-spaces, from the hull of the dual points normal / offset.
/// @return nothing if the intersection is not bounded, or so only by faces that rounding cannot tell from none
template <int Dim>
std::optional<std::vector<Vec<Dim>>> intersection_vertices(const std::vector<HalfSpace<Dim>>& half_spaces);

}  // namespace floc
