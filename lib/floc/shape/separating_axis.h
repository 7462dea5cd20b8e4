#pragma once

#include <cstdint>

#include "floc/shape/placed_shape.h"

namespace floc {

/// Kind of axis between two shapes: it is normal to a face of the first or the second shape, or to a pair of
/// edges.
enum class AxisKind : std::uint8_t { kNone, kFaceOfFirst, kFaceOfSecond, kEdgePair };

/// Features of two shapes that defined the separating axis of the pair, with which the next search for this
/// pair begins. They are kept for each pair of grains from step to step. If they are lost, the search only
/// takes longer.
struct AxisFeatures {
  AxisKind kind = AxisKind::kNone;
  std::int16_t first = 0;   ///< index of the face or edge of the first shape
  std::int16_t second = 0;  ///< index of the face or edge of the second shape
};

/// Face of one shape with the largest separation from another shape, and the vertex of the other shape that is
/// lowest above this face.
struct FaceAxis {
  int face = -1;  ///< index of the face; -1 if the shape has no face
  int vertex = 0;
  double separation = 0.0;  ///< separation in the unit of length of the first shape
};

/// Axis of the largest separation of the cores of two shapes (without rounding), in the coordinates of the
/// first shape.
template <int Dim>
struct SeparatingAxis {
  AxisFeatures features;
  double separation = 0.0;
  FaceAxis of_first, of_second;
};

/// Margins by which one kind of axis is preferred to another, in the unit of length of the first shape.
struct AxisMargins {
  /// Margin by which faces of the first shape are preferred to faces of the second shape, and the face of the
  /// previous step to other faces.
  double faces;
  double edges;  ///< margin by which a face is preferred to an edge pair
};

/// Finds the separating axis of two shapes without their rounding. The candidates are the normals of all faces
/// and, in 3D, of the edge pairs whose arcs cross on the Gauss sphere.
///
/// The axis with the largest separation is chosen, with two preferences: an edge pair has to exceed the faces
/// by more than a margin, and a face of the second shape has to exceed the faces of the first shape by more
/// than a margin. The features of the previous step are kept unless others exceed them by the same margins.
///
/// @param limit  separation above which the search ends; any axis that exceeds it is then returned
/// @param last  features found in the previous step; replaced by the features found now
template <int Dim>
SeparatingAxis<Dim> separating_axis(const Shape<Dim>& first, const Shape<Dim>& second,
                                    const RelativePlace<Dim>& place, const AxisMargins& margins, double limit,
                                    AxisFeatures& last);

/// Returns the normal of an edge pair (length one) that points out of the first shape; zero if the sine
/// of the angle between the edges is below 1e-9.
Vec<3> edge_pair_normal(const Shape<3>& first, int edge, const Shape<3>& second, int other_edge,
                        const RelativePlace<3>& place);

}  // namespace floc
