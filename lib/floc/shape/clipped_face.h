#pragma once

#include <array>

#include "floc/shape/manifold.h"
#include "floc/shape/placed_shape.h"

namespace floc {

/// Contact points of two shapes, of which one touches with its reference face: the corners of the incident face of the
/// other shape, clipped to the reference face. They are in the coordinates of the shape with the reference face.
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
/// Among the faces that meet at the vertex `lowest`, the incident face is the one whose normal is most nearly opposite
/// to that of the reference face. (The face with the most nearly opposite normal of all faces may not contain this
/// vertex.) If `incident` is a point or a segment without faces, all of it is clipped.
///
/// @param place  transformation from the coordinates of `incident` to the coordinates of `reference`
/// @param lowest  vertex of `incident` that is lowest above the reference face
/// @param reach  largest height of a point above the reference face (length)
/// @param tolerance  length: points that are closer are merged, and heights that differ by less count as equal
template <int Dim>
ClippedFace<Dim> clipped_face(const Shape<Dim>& reference, int face, const Shape<Dim>& incident,
                              const RelativePlace<Dim>& place, int lowest, double reach, double tolerance);

}  // namespace floc
