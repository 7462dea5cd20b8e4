#pragma once

#include <vector>

#include "floc/base/vec.h"

namespace floc {

/// Corners and faces of a convex polytope, or of a surface that a file describes. In 2D a face is a side: the
/// loop of its two ends.
template <int Dim>
struct Polytope {
  std::vector<Vec<Dim>> vertices;
  /// Indices of the vertices around each face, counter-clockwise as seen from outside.
  std::vector<std::vector<int>> faces;
};

/// Largest number of vertices of a shape.
inline constexpr int kMostVertices = 200;
/// Largest number of faces, and of edges: keys of contact points have ten bits for each, and one value to
/// spare.
inline constexpr int kMostFaces = 1023;

}  // namespace floc
