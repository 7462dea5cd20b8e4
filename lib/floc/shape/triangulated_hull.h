#pragma once

#include <array>
#include <string>
#include <vector>

#include "floc/base/vec.h"

namespace floc {

/// Triangle on the surface of a convex hull; its corners are counter-clockwise as seen from outside.
struct HullTriangle {
  std::array<int, 3> corner;  ///< indices of the points at the corners of the triangle
  /// Indices of the three adjacent triangles; the edge from corner k to the next corner is shared with triangle
  /// across[k].
  std::array<int, 3> across;
  Vec<3> normal = Vec<3>::Zero();
  double offset = 0.0;      ///< value of normal . x for points x in the plane of the triangle
  double twice_area = 0.0;  ///< twice the area of the triangle (length^2)
};

/// Returns the triangles on the surface of the convex hull of points. Points outside the surface count as inside if
/// their distance from it is less than 1e-10 of the largest extent of the points.
/// @throws InputError if all points lie in one plane to within 1e-9 of the largest extent
std::vector<HullTriangle> triangulated_hull(const std::vector<Vec<3>>& points, const std::string& place);

}  // namespace floc
