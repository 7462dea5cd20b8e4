#pragma once

#include "floc/base/vec.h"

namespace floc {

/// Returns the volume (in 2D the area) of the intersection of a ball and a box, in closed form. The absolute rounding
/// error is about 1e-15 radius^Dim.
///
/// By the divergence theorem, the part of a unit ball beyond the three planes x = a, y = b, z = c >= 0 has the volume
/// (S - a A_a - b A_b - c A_c)/3. A_a, A_b, A_c are the areas of the flat faces of this part, each a part of a disk
/// beyond two lines. S is the area of its spherical face, by the Gauss-Bonnet theorem. The intersection with a box is a
/// signed sum of eight such parts, one for each corner (in 2D, four).
/// @param centre, radius  centre and radius of the ball (length)
/// @param low, high       corners of the box, whose edges are along the axes (length); infinite coordinates are allowed
template <int Dim>
double ball_in_box(const Vec<Dim>& centre, double radius, const Vec<Dim>& low, const Vec<Dim>& high);

}  // namespace floc
