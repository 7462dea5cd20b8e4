#pragma once

#include <vector>

#include "floc/picture/view.h"
#include "floc/shape/placed_shape.h"

namespace floc {

/// Returns the order in which convex bodies have to be drawn so that nearer bodies cover farther bodies: the farthest
/// body is the first. Two convex bodies that do not overlap are separated by a plane. If their images overlap, the body
/// on the side of the plane towards the eye is in front.
///
/// Bodies, for example three sticks, can cover each other in a cycle. The body of the cycle with the farthest centre is
/// drawn first, although it should cover part of another body.
std::vector<int> drawing_order(const std::vector<PlacedShape<3>>& bodies, const Camera& camera);

}  // namespace floc
