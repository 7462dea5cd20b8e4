#pragma once

#include "floc/shape/polytope.h"
#include "floc/shape/shape.h"

namespace floc {

/// Returns a surface with flat faces that is close to the surface of a shape, in the coordinates of the shape. Without
/// rounding, the surface is that of the core (the shape without rounding). With rounding, each vertex of the core is
/// moved by the radius of rounding in 42 directions (to the vertices and the midpoints of the edges of an icosahedron),
/// and the result is the convex hull of all moved points. The hull is inside the shape; its distance from the surface
/// of the shape is at most a seventh of the radius of rounding.
Polytope<3> surface_of(const Shape<3>& shape);

}  // namespace floc
