#pragma once

#include <vector>

#include "floc/shape/manifold.h"
#include "floc/shape/placed_shape.h"

namespace floc {

/// Contact points of two shapes. The reference face of one shape touches the incident face of the other shape. The
/// contact points are the corners of the incident face after it has been clipped by the sides of the reference face.
/// The coordinates are those of the shape with the reference face.
template <int Dim>
struct ClippedFace {
  struct Point {
    Vec<Dim> x;
    double height;  ///< height above the plane of the reference face (length)
    /// Number of the side of the clipped polygon that begins at this point: the number of a side of the incident face,
    /// or 512 plus the number of a side of the reference face.
    int side;
  };

  int incident_face = 0;
  std::vector<Point> points;
};

/// Options of clipped_face(), with lengths in the unit of the reference shape.
struct ClipOptions {
  double reach;        ///< largest height of a point above the reference face (length)
  double tolerance;    ///< distance below which points are merged (length)
  double level = 0.0;  ///< largest difference of heights of vertices that count as equally high (length)
};

/// Clips the incident face, a face of the shape `incident`, by the sides of the reference face, the face `face` of the
/// shape `reference`. Returns the corners of the clipped polygon that are less than `reach` above the reference face.
///
/// Among the faces that meet at the vertex `lowest`, the incident face is the face whose normal is closest to the
/// opposite of the normal of the reference face. (A face without this vertex may have a normal that is even closer.)
/// With a positive `level`, only the faces with the largest number of vertices that are at most `level` above the
/// lowest vertex are considered. If `incident` is a point or a segment without faces, the point or the segment is
/// clipped.
///
/// @param place  transformation from the coordinates of `incident` to the coordinates of `reference`
/// @param lowest  vertex of `incident` with the smallest height above the reference face
template <int Dim>
ClippedFace<Dim> clipped_face(const Shape<Dim>& reference, int face, const Shape<Dim>& incident,
                              const RelativePlace<Dim>& place, int lowest, const ClipOptions& options);

}  // namespace floc
