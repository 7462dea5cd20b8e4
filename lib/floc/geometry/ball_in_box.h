#pragma once

#include "floc/base/vec.h"

namespace floc {

/// Returns the volume (in 2D the area) that a ball and a box have in common, in closed form.
///
/// The part of a unit sphere beyond three planes x = a, y = b, z = c >= 0 has, by the divergence theorem, the
/// volume (S - a A_a - b A_b - c A_c)/3: A are its flat faces, parts of disks beyond two lines, and S is its
/// part of the sphere, by the Gauss-Bonnet theorem. A box is a signed sum of eight such parts.
/// @param centre, radius  of the ball (length)   @param low, high  corners of the box, its edges along the axes
/// (length); an axis from -infinity to infinity is not bounded
/// Absolute rounding error of some 1e-15 radius^Dim.
template <int Dim>
double ball_in_box(const Vec<Dim>& centre, double radius, const Vec<Dim>& low, const Vec<Dim>& high);

}  // namespace floc
