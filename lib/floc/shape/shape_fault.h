#pragma once

#include <optional>
#include <string>

#include "floc/shape/shape.h"

namespace floc {

/// Fault of a shape that was read from a file: the name of the wrong member of Shape, and the reason as text.
struct ShapeFault {
  const char* member;
  std::string words;
};

/// Returns a fault of the faces of a shape, or std::nullopt if the faces enclose a body. Each face has to have distinct
/// vertices of the shape. In 3D each edge has to belong to two faces, which list the ends of the edge in opposite
/// order; in 2D each vertex has to belong to two sides. A core without faces has to be a point or, in 3D, a segment.
/// Only the members `vertices`, `corners`, `first_corner` and `normals` are used.
template <int Dim>
std::optional<ShapeFault> fault_of_faces(const Shape<Dim>& shape);

/// Returns a fault of the geometry of a shape, or std::nullopt if there is none. The shape has to be convex, with
/// correct normals and offsets of the faces. The centre of mass has to be at the origin, and the principal axes have to
/// be the coordinate axes. The relative errors of the volume, the moments of inertia and the radii have to be below
/// 1e-9.
/// @pre the faces have no fault (fault_of_faces())
template <int Dim>
std::optional<ShapeFault> fault_of_geometry(const Shape<Dim>& shape);

}  // namespace floc
