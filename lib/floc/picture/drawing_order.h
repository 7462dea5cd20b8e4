#pragma once

#include <vector>

#include "floc/picture/view.h"
#include "floc/shape/placed_shape.h"

namespace floc {

/// Returns the order, from the farthest to the nearest, in which convex bodies have to be drawn so that nearer bodies
/// cover farther ones. Two convex bodies that do not overlap are separated by a plane. Where the images of the bodies
/// overlap, the body on the side of the plane towards the eye is in front.
///
/// Bodies can cover each other in a cycle, as three sticks can. Then the body of the cycle with the farthest centre is
/// drawn first, although it should cover part of another body.
std::vector<int> drawing_order(const std::vector<PlacedShape<3>>& bodies, const Camera& camera);

}  // namespace floc
