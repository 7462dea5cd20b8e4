#pragma once

#include <span>
#include <string>
#include <vector>

#include "floc/base/vec.h"
#include "floc/shape/convex_hull.h"
#include "floc/shape/polytope.h"

namespace floc {

/// Edge of a polyhedron between two of its faces.
struct ShapeEdge {
  int from, to;     ///< vertices
  int left, right;  ///< faces, as seen from outside with `from` below and `to` above
};

/// Convex grain: the sum of a core and a ball of radius `rounding`. The core is a polytope, a segment (two
/// vertices: a capsule) or a point (no vertex: a disk or sphere).
///
/// Coordinates are about the centre of mass of the rounded shape, in 3D along its principal axes. Faces of the
/// core have outward unit normals n, and n . x = offset on them. In 2D faces are sides, in counter-clockwise
/// order, and there are no edges; a segment in the plane has two sides, in space no face. Numbers of length
/// have the unit of the vertices; mass properties are those of density 1.
template <int Dim>
struct Shape {
  std::vector<Vec<Dim>> vertices;
  std::vector<Vec<Dim>> normals;
  std::vector<double> offsets;
  std::vector<int> corners;          ///< vertices around the faces, counter-clockwise as seen from outside
  std::vector<int> first_corner;     ///< of each face in `corners`, then the number of corners
  std::vector<ShapeEdge> edges;      ///< each once
  std::vector<int> vertex_faces;     ///< faces that meet at the vertices
  std::vector<int> first_of_vertex;  ///< of each vertex in `vertex_faces`, then the number of these
  double rounding = 0.0;

  double volume = 0.0;                                        ///< area in 2D
  RotationVector<Dim> inertia = RotationVector<Dim>::Zero();  ///< principal moments (length^(Dim + 2))
  double outer_radius = 0.0;  ///< of the circumscribed circle or sphere about the centre of mass
  double inner_radius =
      0.0;  ///< of the largest one inside about the centre of mass; of a core, 0 for a segment, more the rounding

  /// Place of the shape in the coordinates that it was given in: given = centre + axes * own.
  Vec<Dim> centre = Vec<Dim>::Zero();
  Mat<Dim> axes = Mat<Dim>::Identity();

  int n_vertices() const { return static_cast<int>(vertices.size()); }
  int n_faces() const { return static_cast<int>(normals.size()); }
  int n_edges() const { return static_cast<int>(edges.size()); }
  bool is_round() const { return vertices.empty(); }
  std::span<const int> loop(int face) const {
    return {corners.data() + first_corner[face], corners.data() + first_corner[face + 1]};
  }
  std::span<const int> faces_at(int vertex) const {
    return {vertex_faces.data() + first_of_vertex[vertex], vertex_faces.data() + first_of_vertex[vertex + 1]};
  }
  double diameter() const { return 2.0 * outer_radius; }
  /// Diameter of the disk or sphere of equal volume.
  double equal_volume_diameter() const;
};

/// Disk or sphere.
template <int Dim>
Shape<Dim> round_shape(double radius);

/// Segment of a given length along the first axis, rounded.
template <int Dim>
Shape<Dim> capsule_shape(double length, double rounding);

/// Shape whose core is a convex polytope.
///
/// @param hull   its faces are those of convex_hull()
/// @param place  for messages
/// @throws InputError if there are more than kMostVertices vertices or kMostFaces faces or edges, the volume of
/// the core is below 1e-6 of its box, or its extents along the principal axes differ by more than a factor of
/// 20
template <int Dim>
Shape<Dim> polytope_shape(const Polytope<Dim>& hull, double rounding, const std::string& place = "");

/// A shape made of points, and remarks in words about points that it did not take.
template <int Dim>
struct ShapeOfPoints {
  Shape<Dim> shape;
  std::vector<std::string> remarks;
};

/// Hull of points, rounded.
///
/// @throws InputError as convex_hull() and polytope_shape(), and if two points are closer than 1e-9 of the
/// largest extent
template <int Dim>
ShapeOfPoints<Dim> shape_of_points(const std::vector<Vec<Dim>>& points, double rounding,
                                   const std::string& place = "");

/// Shape magnified by a factor > 0.
template <int Dim>
Shape<Dim> scaled(Shape<Dim> shape, double factor);

/// Refuses points closer than 1e-9 of the largest extent. @throws InputError naming two of them
template <int Dim>
void require_distinct(const std::vector<Vec<Dim>>& points, const std::string& place);

/// Shape whose rounding is a given share of its diameter.
///
/// @param share  from 0 (sharp) to 0.45
/// @throws InputError as polytope_shape(), and if the share is out of its range
template <int Dim>
Shape<Dim> with_rounding_share(const Polytope<Dim>& core, double share, const std::string& place = "");

/// Such a shape, magnified to a diameter of 1.
template <int Dim>
Shape<Dim> with_unit_diameter(const Polytope<Dim>& core, double share, const std::string& place = "");

}  // namespace floc
