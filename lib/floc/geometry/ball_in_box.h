#pragma once

#include "floc/base/vec.h"

namespace floc {

/// Returns the volume (in 2D the area) of the intersection of a ball and a box, in closed form. The rounding error is
/// about 1e-15 radius^Dim.
///
/// The volume is a sum over the corners of the box. Each corner has one term, which is added or subtracted. Lengths are
/// in units of the radius; the centre of the ball is the origin. The term of a corner (a, b, c) with a, b, c >= 0 is
/// the volume of the part of the ball with x > a, y > b and z > c. By the divergence theorem, this volume is (S - a A_a
/// - b A_b - c A_c)/3. S is the area of the spherical face of this part, from the Gauss-Bonnet theorem. A_a, A_b and
/// A_c are the areas of its flat faces on the planes x = a, y = b and z = c.
/// @param centre, radius  centre and radius of the ball (length)
/// @param low, high       corners of the box, whose edges are along the axes (length); infinite coordinates are allowed
template <int Dim>
double ball_in_box(const Vec<Dim>& centre, double radius, const Vec<Dim>& low, const Vec<Dim>& high);

}  // namespace floc
