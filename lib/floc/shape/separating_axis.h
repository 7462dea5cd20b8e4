#pragma once

#include <cstdint>

#include "floc/shape/placed_shape.h"

namespace floc {

/// Kind of an axis along which two shapes are separated: the normal of a face of the first or the second shape, or the
/// common normal of a pair of edges.
enum class AxisKind : std::uint8_t { kNone, kFaceOfFirst, kFaceOfSecond, kEdgePair };

/// Features (faces or edges) of two shapes that define the separating axis of the shapes. For each pair of grains, the
/// features of one step are stored, and the search in the next step begins with them. Without stored features, the
/// search takes longer but gives the same result up to the margins.
struct AxisFeatures {
  AxisKind kind = AxisKind::kNone;
  std::int16_t first = 0;   ///< index of the face or edge of the first shape
  std::int16_t second = 0;  ///< index of the face or edge of the second shape
};

/// Face of one shape with the largest separation from another shape, and the vertex of the other shape with the
/// smallest height above this face.
struct FaceAxis {
  int face = -1;  ///< index of the face; -1 if the shape has no face
  int vertex = 0;
  double separation = 0.0;  ///< separation in the unit of length of the first shape
};

/// Axis along which two cores (shapes without rounding) have the largest separation, in the coordinates of the first
/// shape.
template <int Dim>
struct SeparatingAxis {
  AxisFeatures features;
  double separation = 0.0;
  FaceAxis of_first, of_second;
};

/// Margins for the choice between two kinds of axis, in the unit of length of the first shape. An axis of one kind is
/// chosen only if its separation exceeds that of a preferred kind by more than the margin.
struct AxisMargins {
  /// Margin for faces. A face of the second shape defines the axis only if its separation exceeds that of every face of
  /// the first shape by more than this margin. The face of the previous step is kept unless the separation of another
  /// face is larger by more than this margin.
  double faces;
  /// margin for edges: the separation of an edge pair has to exceed that of every face by more than this margin
  double edges;
  /// If the shapes overlap along the normals of all faces, the margin for edges is increased by this number times the
  /// smallest of these overlaps.
  double edges_of_overlap = 0.0;
};

/// Finds the axis along which two cores (shapes without rounding) have the largest separation or, if they overlap, the
/// smallest overlap. The candidates are the normals of all faces and, in 3D, the common normals of the edge pairs whose
/// arcs cross on the Gauss sphere.
///
/// The axis with the largest separation is chosen, with two preferences. An edge pair is chosen only if its separation
/// exceeds that of every face by more than a margin. A face of the second shape is chosen only if its separation
/// exceeds that of every face of the first shape by more than a margin. The features of the previous step are kept
/// unless the separation of other features is larger by more than the margin.
///
/// @param limit  separation at which the search ends: the first axis with a larger separation is returned
/// @param last  features that defined the axis in the previous step; they are replaced by the features found now
template <int Dim>
SeparatingAxis<Dim> separating_axis(const Shape<Dim>& first, const Shape<Dim>& second,
                                    const RelativePlace<Dim>& place, const AxisMargins& margins, double limit,
                                    AxisFeatures& last);

/// Returns the unit vector that is normal to two edges, one of each shape, and points out of the first shape. The
/// result is zero if the sine of the angle between the edges is below 1e-9.
Vec<3> edge_pair_normal(const Shape<3>& first, int edge, const Shape<3>& second, int other_edge,
                        const RelativePlace<3>& place);

}  // namespace floc
