#pragma once

#include <array>

#include "floc/shape/manifold.h"
#include "floc/shape/placed_shape.h"

namespace floc {

/// Contact points of two shapes, one of which touches with its reference face: the corners of the incident face of the
/// other shape, clipped to the reference face. The points are in the coordinates of the shape with the reference face.
template <int Dim>
struct ClippedFace {
  struct Point {
    Vec<Dim> x;
    double height;  ///< height above the plane of the reference face (length)
    /// Side of the clipped polygon that begins at this point: number of a side of the incident face, or 512 plus the
    /// number of a side of the reference face.
    int side;
  };

  int incident_face = 0;
  int n = 0;
  std::array<Point, Manifold<Dim>::kMostPoints> points;
};

/// Clips a face of the shape `incident`, the incident face, by the sides of the face `face` of the shape `reference`,
/// the reference face. Of the corners of the clipped polygon, those less than `reach` above the reference face are
/// kept, at most 2 in 2D and 4 in 3D.
///
/// The incident face is one of the faces that meet at the vertex `lowest`: the one whose normal is most nearly opposite
/// to the normal of the reference face. (Among all faces, a face without this vertex may have a more nearly opposite
/// normal.) If `incident` is a point or a segment without faces, all of it is clipped.
///
/// @param place  transformation from the coordinates of `incident` to the coordinates of `reference`
/// @param lowest  vertex of `incident` that is lowest above the reference face
/// @param reach  largest height of a point above the reference face (length)
/// @param tolerance  distance below which points are merged and heights count as equal (length)
template <int Dim>
ClippedFace<Dim> clipped_face(const Shape<Dim>& reference, int face, const Shape<Dim>& incident,
                              const RelativePlace<Dim>& place, int lowest, double reach, double tolerance);

}  // namespace floc
