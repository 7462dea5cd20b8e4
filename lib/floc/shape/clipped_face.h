#pragma once

#include <array>

#include "floc/shape/manifold.h"
#include "floc/shape/placed_shape.h"

namespace floc {

/// Corners of the incident face of one shape that lie over the reference face of another shape, in the
/// coordinates of the reference shape.
template <int Dim>
struct ClippedFace {
  struct Point {
    Vec<Dim> x;
    double height;  ///< height above the plane of the reference face
    /// Side that begins at this point: number of a side of the incident face, or 512 plus the number of a side
    /// of the reference face.
    int side;
  };

  int incident_face = 0;
  int n = 0;
  std::array<Point, Manifold<Dim>::kMostPoints> points;
};

/// Clips the incident face by the sides of the reference face. Of the resulting points, those lower than
/// `reach` above the reference face are kept, at most 2 in 2D and 4 in 3D.
///
/// The incident face is the most antiparallel face among the faces that meet at the lowest vertex. The most
/// antiparallel of all faces may not contain the deepest vertex. A point or a segment is its own incident face.
///
/// @param place  transformation from the coordinates of `incident` to the coordinates of `reference`
/// @param lowest  vertex of `incident` that is lowest above the reference face
/// @param reach  largest height of a point above the reference face (length)
/// @param tolerance  points closer than this length are one point; heights that differ by less are equal
template <int Dim>
ClippedFace<Dim> clipped_face(const Shape<Dim>& reference, int face, const Shape<Dim>& incident,
                              const RelativePlace<Dim>& place, int lowest, double reach, double tolerance);

}  // namespace floc
