#pragma once

#include "floc/base/vec.h"
#include "floc/picture/palette.h"

namespace floc {

/// Smallest radius at which shading is visible (points). Smaller shapes have a single colour, which keeps files small.
inline constexpr double kSmallestShaded = 0.6;

/// Unit vector on the page (x to the right, y down) that points towards the light source.
inline const Vec<2> kLight = Vec<2>(-0.6, -0.8);

inline Color mixed(const Color& a, const Color& b, double share) {
  return {a.red + share * (b.red - a.red), a.green + share * (b.green - a.green),
          a.blue + share * (b.blue - a.blue)};
}

inline Color paler(const Color& color, double share) {
  return mixed(color, {1.0, 1.0, 1.0}, share);
}

inline Color darker(const Color& color, double share) {
  return mixed(color, {0.0, 0.0, 0.0}, share);
}

}  // namespace floc
