#pragma once

#include <vector>

#include "floc/picture/view.h"
#include "floc/shape/placed_shape.h"

namespace floc {

/// Returns the order, from the farthest to the nearest, in which convex bodies have to be drawn so that nearer bodies
/// cover farther ones. A plane separates two convex bodies that do not overlap. Where their images overlap, the body on
/// that side of the plane which faces the eye is in front of the other.
///
/// Bodies can cover each other in a cycle, as three sticks can. Then the body of the cycle with the farthest centre is
/// drawn first, although it should cover part of another body.
std::vector<int> drawing_order(const std::vector<PlacedShape<3>>& bodies, const Camera& camera);

}  // namespace floc
