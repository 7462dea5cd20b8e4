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
  int from, to;  ///< indices of the vertices at the ends of the edge
  /// Indices of the faces to the left and right of the edge, as seen from outside with the vertex `from` below and the
  /// vertex `to` above.
  int left, right;
};

/// Convex shape of a grain: the sum of a core and a ball of radius `rounding`. The core is a polytope, a
/// segment (two vertices: a capsule) or a point (no vertex: a disk or sphere).
///
/// Coordinates are relative to the centre of mass of the rounded shape, in 3D along its principal axes. The faces of
/// the core have outward unit normals n and offsets, with n . x = offset for points x on the face. In 2D the faces are
/// the sides, in counter-clockwise order, and there are no edges. A segment has two sides in 2D and no face in 3D. All
/// lengths have the unit of the coordinates of the vertices. Mass properties are given for density 1.
template <int Dim>
struct Shape {
  std::vector<Vec<Dim>> vertices;
  std::vector<Vec<Dim>> normals;
  std::vector<double> offsets;
  /// Indices of the vertices around each face, counter-clockwise as seen from outside; the lists of all faces follow
  /// each other.
  std::vector<int> corners;
  /// For each face, the index in `corners` of its first vertex; the last element is the size of `corners`.
  std::vector<int> first_corner;
  std::vector<ShapeEdge> edges;  ///< edges, each listed once
  /// indices of the faces that meet at each vertex; the lists of all vertices follow each other
  std::vector<int> vertex_faces;
  /// For each vertex, the index in `vertex_faces` of its first face; the last element is the size of `vertex_faces`.
  std::vector<int> first_of_vertex;
  double rounding = 0.0;

  double volume = 0.0;  ///< volume of the shape; area in 2D
  /// Principal moments of inertia for density 1 (length^(Dim + 2)).
  RotationVector<Dim> inertia = RotationVector<Dim>::Zero();
  double outer_radius = 0.0;  ///< radius of the circumscribed circle or sphere about the centre of mass
  /// Sum of `rounding` and the radius of the largest circle or sphere about the centre of mass that is inside the core
  /// (0 for a segment).
  double inner_radius = 0.0;

  /// Centre and axes of the shape in the coordinate system of the points from which the shape was made: the point y of
  /// the shape has the coordinates x = centre + axes * y in this system.
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
  /// Returns the diameter of the disk or sphere of equal volume.
  double equal_volume_diameter() const;
};

/// Returns a disk or sphere.
template <int Dim>
Shape<Dim> round_shape(double radius);

/// Returns a capsule: the points within the distance `rounding` of a segment of length `length` along the first axis.
template <int Dim>
Shape<Dim> capsule_shape(double length, double rounding);

/// Returns a capsule whose core is the segment between two points, with Shape::centre and Shape::axes.
/// @throws InputError if the points are the same, or if the capsule is more than 20 times as long as it is thick
template <int Dim>
Shape<Dim> capsule_between(const Vec<Dim>& from, const Vec<Dim>& to, double rounding, const std::string& place);

/// Returns the shape whose core (the shape without its rounding) is a convex polytope.
///
/// @param hull  polytope with the faces of convex_hull()
/// @param place  source of the polytope for messages, such as the name of a file
/// @throws InputError if there are more than kMostVertices vertices or kMostFaces faces or edges, if the volume of the
/// core is less than 1e-6 of the volume of its bounding box, if the core is not convex, or if the largest extent of the
/// core along a principal axis is more than 20 times the smallest
template <int Dim>
Shape<Dim> polytope_shape(const Polytope<Dim>& hull, double rounding, const std::string& place = "");

/// Shape made from points, with remarks about points that are not vertices of the shape.
template <int Dim>
struct ShapeOfPoints {
  Shape<Dim> shape;
  std::vector<std::string> remarks;
};

/// Returns the rounded convex hull of points.
///
/// @throws InputError if convex_hull() or polytope_shape() throws it, or if the distance of two points is less than
/// 1e-9 of the largest extent of all points
template <int Dim>
ShapeOfPoints<Dim> shape_of_points(const std::vector<Vec<Dim>>& points, double rounding,
                                   const std::string& place = "");

/// Returns the core of a shape (the shape without its rounding).
template <int Dim>
Polytope<Dim> core_of(const Shape<Dim>& shape);

/// Returns a shape whose lengths are multiplied by a factor > 0.
template <int Dim>
Shape<Dim> scaled(Shape<Dim> shape, double factor);

/// Requires that the distance of any two points is at least 1e-9 of the largest extent of all points.
/// @throws InputError that names two points with a smaller distance
template <int Dim>
void require_distinct(const std::vector<Vec<Dim>>& points, const std::string& place);

/// Returns a shape with the given core (the shape without rounding) and a radius of rounding that is a given fraction
/// of the diameter of the shape.
///
/// @param share  radius of rounding divided by the diameter, from 0 (sharp) to 0.45
/// @throws InputError if polytope_shape() throws it, or if the fraction is out of range
template <int Dim>
Shape<Dim> with_rounding_share(const Polytope<Dim>& core, double share, const std::string& place = "");

/// Returns the shape of with_rounding_share(), scaled to the diameter 1.
template <int Dim>
Shape<Dim> with_unit_diameter(const Polytope<Dim>& core, double share, const std::string& place = "");

}  // namespace floc
