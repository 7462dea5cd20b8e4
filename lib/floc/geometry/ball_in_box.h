#pragma once

#include "floc/base/vec.h"

namespace floc {

/// Returns the volume (in 2D the area) of the intersection of a ball and a box, in closed form. The absolute rounding
/// error is about 1e-15 radius^Dim.
///
/// The volume is a signed sum over the corners of the box. In units of the radius, and with the centre of the ball as
/// origin, the term of a corner (a, b, c) with a, b, c >= 0 is the volume of the part of the ball with x > a, y > b, z
/// > c. By the divergence theorem it is (S - a A_a - b A_b - c A_c)/3. Here S is the area of the spherical face of this
/// part, from the Gauss-Bonnet theorem, and A_a, A_b, A_c are the areas of its flat faces on the planes x = a, y = b, z
/// = c.
/// @param centre, radius  centre and radius of the ball (length)
/// @param low, high       corners of the box, whose edges are along the axes (length); infinite coordinates are allowed
template <int Dim>
double ball_in_box(const Vec<Dim>& centre, double radius, const Vec<Dim>& low, const Vec<Dim>& high);

}  // namespace floc
