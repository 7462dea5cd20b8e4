#pragma once

#include <cstdint>

#include "floc/shape/placed_shape.h"

namespace floc {

/// Kind of features that the axis between two cores is normal to.
enum class AxisKind : std::uint8_t { kNone, kFaceOfFirst, kFaceOfSecond, kEdgePair };

/// Features that gave the axis of a pair, which the next search for the pair begins with. One is kept for each
/// pair of grains from step to step; it can be lost at no cost but time.
struct AxisFeatures {
  AxisKind kind = AxisKind::kNone;
  std::int16_t first = 0;   ///< face or edge of the first shape
  std::int16_t second = 0;  ///< face or edge of the second shape
};

/// The face of one shape with the largest separation, and the vertex of the other that is lowest above it.
struct FaceAxis {
  int face = -1;  ///< none where the core has no face
  int vertex = 0;
  double separation = 0.0;  ///< in the unit of the first shape's own coordinates
};

/// Axis of the largest separation of two cores, in the own coordinates of the first.
template <int Dim>
struct SeparatingAxis {
  AxisFeatures features;
  double separation = 0.0;
  FaceAxis of_first, of_second;
};

/// Margins within which an axis of lower rank is preferred, as lengths in the first shape's own unit.
struct AxisMargins {
  double faces;  ///< a face of the second over one of the first, and any face over that of the step before
  double edges;  ///< an edge pair over faces
};

/// Separating axes: faces of both cores, and in 3D the edge pairs whose arcs cross on the Gauss sphere.
///
/// The largest separation wins, but an edge pair only where it beats faces, and a face of the second shape only
/// where it beats one of the first, by more than a margin; the features of the step before keep their place
/// within the same margin.
///
/// @param limit  separation above which the search ends, with whatever axis has been found to exceed it
/// @param last   features of the step before; those found are written to it
template <int Dim>
SeparatingAxis<Dim> separating_axis(const Shape<Dim>& first, const Shape<Dim>& second,
                                    const RelativePlace<Dim>& place, const AxisMargins& margins, double limit,
                                    AxisFeatures& last);

/// Normal of an edge pair (length one), out of the first shape. Zero where the edges are parallel to 1e-9.
Vec<3> edge_pair_normal(const Shape<3>& first, int edge, const Shape<3>& second, int other_edge,
                        const RelativePlace<3>& place);

}  // namespace floc
