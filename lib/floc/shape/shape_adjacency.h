#pragma once

#include "floc/shape/shape.h"

namespace floc {

/// Computes the edges of a shape, and the lists of the faces that meet at each vertex, from the lists of the vertices
/// around each face.
/// @pre in 3D, every edge belongs to two faces, which list the ends of the edge in opposite order
template <int Dim>
void set_adjacency(Shape<Dim>& shape);

}  // namespace floc
