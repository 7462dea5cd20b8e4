#pragma once

#include <array>
#include <string>
#include <vector>

#include "floc/base/vec.h"

namespace floc {

/// Triangle on the surface of a hull, counter-clockwise as seen from outside.
struct HullTriangle {
  std::array<int, 3> corner;  ///< indices of points
  std::array<int, 3> across;  ///< triangle beyond the edge from each corner to the next
  Vec<3> normal = Vec<3>::Zero();
  double offset = 0.0;      ///< normal . x on its plane
  double twice_area = 0.0;  ///< (length^2)
};

/// Closed surface of the convex hull of points. Points within 1e-10 of the largest extent of it count as
/// inside.
/// @throws InputError if all points lie in one plane to 1e-9 of the largest extent
std::vector<HullTriangle> triangulated_hull(const std::vector<Vec<3>>& points, const std::string& place);

}  // namespace floc
