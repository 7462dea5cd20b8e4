#pragma once

#include "floc/shape/polytope.h"
#include "floc/shape/shape.h"

namespace floc {

/// Returns a surface with flat faces close to the surface of a shape, in the coordinates of the shape. Without rounding
/// it is the core itself. With rounding, the vertices of the core are moved by the radius of rounding in 42 directions
/// (to the vertices and the midpoints of the edges of an icosahedron), and the result is the convex hull of the moved
/// points. The hull is inside the shape, by at most a seventh of the radius of rounding.
Polytope<3> surface_of(const Shape<3>& shape);

}  // namespace floc
