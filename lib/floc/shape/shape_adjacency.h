#pragma once

#include "floc/shape/shape.h"

namespace floc {

/// Sets the edges of a shape, and the lists of the faces that meet at its vertices, from the vertices around each face.
/// @pre in 3D, every edge is between two faces, which list its ends in opposite order
template <int Dim>
void set_adjacency(Shape<Dim>& shape);

}  // namespace floc
