#pragma once

#include "floc/shape/polytope.h"
#include "floc/shape/shape.h"

namespace floc {

/// Returns a surface with flat faces close to the surface of a shape, in the coordinates of the shape. Without rounding it is
/// the core itself. With rounding it is the convex hull of the core's vertices moved by the radius of rounding in 42
/// directions (those of the vertices and of the midpoints of the edges of an icosahedron), which lie on the surface; the hull is
/// inside the shape, by at most a seventh of the radius of rounding.
Polytope<3> surface_of(const Shape<3>& shape);

}  // namespace floc
