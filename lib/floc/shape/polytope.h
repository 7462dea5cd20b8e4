#pragma once

#include <vector>

#include "floc/base/vec.h"

namespace floc {

/// Vertices and faces of a convex polytope, or of a surface described by a file. In 2D a face is a side, given
/// by its two ends.
template <int Dim>
struct Polytope {
  std::vector<Vec<Dim>> vertices;
  /// Indices of the vertices around each face, counter-clockwise as seen from outside.
  std::vector<std::vector<int>> faces;
};

/// Largest number of vertices of a shape of a grain.
inline constexpr int kMostVertices = 200;
/// Largest number of faces, and of edges, of a shape of a grain. ManifoldPoint::key has ten bits for the index of a
/// face or edge; the value 1023 is not used as an index.
inline constexpr int kMostFaces = 1023;

/// Smallest and largest length in a shape: kLeastLength is a lower bound of the largest extent of the points of a
/// shape, kLargestLength an upper bound of their coordinates. Moments of inertia are sums of fifth powers of lengths;
/// within the bounds, these powers do not underflow or overflow.
inline constexpr double kLeastLength = 1e-50;
inline constexpr double kLargestLength = 1e50;

}  // namespace floc
