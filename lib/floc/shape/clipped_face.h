#pragma once

#include <array>

#include "floc/shape/manifold.h"
#include "floc/shape/placed_shape.h"

namespace floc {

/// Points of an incident face over a reference face, in the own coordinates of the reference shape.
template <int Dim>
struct ClippedFace {
  struct Point {
    Vec<Dim> x;
    double height;  ///< above the reference face
    int side;  ///< side that begins at it: of the incident face, or 512 more than one of the reference face
  };

  int incident_face = 0;
  int n = 0;
  std::array<Point, Manifold<Dim>::kMostPoints> points;
};

/// Clips the incident face by the sides of the reference face and keeps points below `reach`, at most 2 or 4.
///
/// The incident face is the most antiparallel among those at the lowest vertex: the most antiparallel of all
/// misses the deepest vertex. Cores of one or two vertices are their own incident face.
///
/// @param place   takes own coordinates of `incident` to those of `reference`
/// @param lowest  vertex of `incident` that is lowest above the face
/// @param tolerance  length: points nearer than that are one, heights nearer than that are equal
template <int Dim>
ClippedFace<Dim> clipped_face(const Shape<Dim>& reference, int face, const Shape<Dim>& incident,
                              const RelativePlace<Dim>& place, int lowest, double reach, double tolerance);

}  // namespace floc
