#pragma once

#include <string>
#include <vector>

#include "floc/shape/polytope.h"

namespace floc {

/// Largest number of points for which a convex hull is computed.
inline constexpr int kMostHullPoints = 20000;

/// Convex hull of points, with coplanar triangles merged into faces.
template <int Dim>
struct ConvexHull {
  /// Convex hull; its vertices are ordered like the given points (3D) or around the polygon (2D).
  Polytope<Dim> polytope;
  std::vector<int> points;  ///< for each vertex, the index of the given point at the vertex
};

/// Computes the convex hull of points. The algorithm is that of Barber, Dobkin and Huhdanpaa (ACM Trans. Math. Softw.
/// 22, 1996) in 3D, and Andrew's monotone chain in 2D. Adjacent faces whose normals differ by less than 1e-6 radians
/// are merged. Points on a face or an edge are not vertices of the hull.
///
/// @param place  source of the points for messages, such as the name of a file
/// @throws InputError if there are fewer than Dim + 1 points or more than kMostHullPoints, if a coordinate is not a
/// finite number or exceeds kLargestLength, if the largest extent is below kLeastLength, or if the points are so close
/// to one plane (in 2D one line) that their hull cannot be determined
template <int Dim>
ConvexHull<Dim> convex_hull(const std::vector<Vec<Dim>>& points, const std::string& place = "");

}  // namespace floc
