#pragma once

#include "floc/shape/shape.h"

namespace floc {

/// Sets the edges of a shape and the faces that meet at its vertices, which follow from the vertices around each face.
/// @pre in 3D, every edge is between two faces, which have it in opposite directions
template <int Dim>
void set_adjacency(Shape<Dim>& shape);

}  // namespace floc
