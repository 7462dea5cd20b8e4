#pragma once

#include <cmath>

#include "floc/picture/outline.h"

namespace floc::test {

/// Returns the area inside an outline: half the integral of x dy - y dx along its arcs and straight sides.
inline double area_of(const Outline& outline) {
  const double r = outline.radius;
  const auto on_circle = [](double angle) { return Vec<2>(std::cos(angle), std::sin(angle)); };
  const auto cross = [](const Vec<2>& a, const Vec<2>& b) { return a[0] * b[1] - a[1] * b[0]; };
  double twice = 0.0;
  for (std::size_t k = 0; k < outline.corners.size(); ++k) {
    const OutlineCorner& corner = outline.corners[k];
    const OutlineCorner& next = outline.corners[(k + 1) % outline.corners.size()];
    const Vec<2> begin = on_circle(corner.begin), end = on_circle(corner.end);
    twice += r * cross(corner.centre, end - begin) + r * r * (corner.end - corner.begin);
    twice += cross(corner.centre + r * end, next.centre + r * on_circle(next.begin));
  }
  return 0.5 * twice;
}

}  // namespace floc::test
