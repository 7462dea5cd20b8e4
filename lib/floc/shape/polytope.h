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

}  // namespace floc
