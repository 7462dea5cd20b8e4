#pragma once

#include <optional>
#include <string>

#include "floc/shape/shape.h"

namespace floc {

/// Fault of a shape that was read from a file: the member of Shape at fault, and the reason as text.
struct ShapeFault {
  const char* member;
  std::string words;
};

/// Returns a fault of the faces of a shape, or std::nullopt if the faces enclose a body: each face has distinct
/// vertices of the shape, and each edge (in 2D, each vertex) is between two faces, which list its ends in opposite
/// order. A core without faces has to be a point or, in 3D, a segment. Only the members `vertices`, `corners`,
/// `first_corner` and `normals` are used.
template <int Dim>
std::optional<ShapeFault> fault_of_faces(const Shape<Dim>& shape);

/// Returns a fault of the geometry of a shape whose faces have no fault, or std::nullopt. The shape has to be convex,
/// and the normals and offsets of its faces have to be correct. The centre of mass has to be at the origin and the
/// principal axes along the coordinate axes. The volume, moments of inertia and radii have to be correct to 1e-9.
template <int Dim>
std::optional<ShapeFault> fault_of_geometry(const Shape<Dim>& shape);

}  // namespace floc
