#pragma once

#include <string>
#include <vector>

#include "floc/shape/polytope.h"

namespace floc {

/// Largest number of points that a hull is taken of.
inline constexpr int kMostHullPoints = 20000;

/// Convex hull of points, with coplanar triangles merged into faces.
template <int Dim>
struct ConvexHull {
  Polytope<Dim> polytope;   ///< vertices in the order of the points
  std::vector<int> points;  ///< index of the point at each vertex
};

/// Takes the convex hull, by Barber, Dobkin and Huhdanpaa's order of points (ACM Trans. Math. Softw. 22, 1996)
/// in 3D and by Andrew's chain in 2D. Faces whose directions differ by less than 1e-6 are one; points that lie
/// on a face or an edge are no vertices.
///
/// @param place  of the points, for messages
/// @throws InputError if there are fewer than Dim + 1 points or more than kMostHullPoints, if a coordinate is
/// not finite, or if all points lie in one plane (in 2D on one line)
template <int Dim>
ConvexHull<Dim> convex_hull(const std::vector<Vec<Dim>>& points, const std::string& place = "");

}  // namespace floc
