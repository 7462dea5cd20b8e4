#include "floc/picture/outline.h"

#include <cmath>
#include <numbers>

namespace floc {

Outline outline_of(const PlacedShape<2>& placed) {
  const Shape<2>& shape = *placed.shape;
  const auto angle_of = [&](int side) {
    const Vec<2> normal = placed.rotation * shape.normals[side];
    return std::atan2(normal[1], normal[0]);
  };
  Outline outline;
  outline.radius = placed.rounding();
  const int n = shape.n_faces();
  for (int side = 0; side < n; ++side) {
    // The arc about the first vertex of a side begins at the direction of the normal of the previous side. It ends at
    // the direction of the normal of the side itself.
    const Vec<2>& vertex = shape.vertices[shape.loop(side).front()];
    const double begin = angle_of((side + n - 1) % n);
    double end = angle_of(side);
    if (end <= begin) end += 2.0 * std::numbers::pi;
    outline.corners.push_back({placed.position + placed.scale * (placed.rotation * vertex), begin, end});
  }
  return outline;
}

}  // namespace floc
