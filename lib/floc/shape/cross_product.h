#pragma once

#include "floc/base/vec.h"

namespace floc {

/// Returns the third component of the cross product of two vectors in the plane: twice the area of the triangle between
/// them, positive if the rotation from a to b is counter-clockwise.
inline double cross_product(const Vec<2>& a, const Vec<2>& b) {
  return a[0] * b[1] - a[1] * b[0];
}

}  // namespace floc
