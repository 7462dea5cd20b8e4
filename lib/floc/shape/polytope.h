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
/// face or edge, of which one value is left over.
inline constexpr int kMostFaces = 1023;

/// Least and largest length in a shape: the largest extent of its points, and their distance from the origin. The
/// fifth powers of these lengths, of which moments of inertia are sums, are far from the least and the largest double.
inline constexpr double kLeastLength = 1e-50;
inline constexpr double kLargestLength = 1e50;

}  // namespace floc
