#pragma once

#include "floc/shape/shape.h"

namespace floc {

/// Shape of a grain placed in space: the point y of the shape lies at x = position + scale * rotation * y in space.
template <int Dim>
struct PlacedShape {
  const Shape<Dim>* shape = nullptr;
  double scale = 1.0;
  Vec<Dim> position = Vec<Dim>::Zero();      ///< position of the centre of mass
  Mat<Dim> rotation = Mat<Dim>::Identity();  ///< rotation from the axes of the shape to the axes of space

  double rounding() const { return scale * shape->rounding; }
  double inner_radius() const { return scale * shape->inner_radius; }
  double outer_radius() const { return scale * shape->outer_radius; }
};

/// Transformation from the coordinates of a second shape to the coordinates of a first shape: the point y of the second
/// shape has the coordinates x = offset + scale * rotation * y of the first shape.
template <int Dim>
struct RelativePlace {
  Mat<Dim> rotation;
  Vec<Dim> offset;
  double scale;

  RelativePlace(const Mat<Dim>& turn, const Vec<Dim>& shift, double factor)
      : rotation(turn), offset(shift), scale(factor) {}
  RelativePlace(const PlacedShape<Dim>& first, const PlacedShape<Dim>& second)
      : rotation(first.rotation.transpose() * second.rotation),
        offset(first.rotation.transpose() * (second.position - first.position) / first.scale),
        scale(second.scale / first.scale) {}

  RelativePlace inverse() const {
    return {rotation.transpose(), Vec<Dim>(rotation.transpose() * offset / -scale), 1.0 / scale};
  }
  Vec<Dim> point(const Vec<Dim>& own) const { return offset + scale * (rotation * own); }
  Vec<Dim> direction(const Vec<Dim>& own) const { return rotation * own; }
};

/// Returns a vertex of the core of a shape (the shape without its rounding). A core that is a point has one
/// vertex, its centre.
template <int Dim>
inline Vec<Dim> core_vertex(const Shape<Dim>& shape, int vertex) {
  return shape.is_round() ? Vec<Dim>(Vec<Dim>::Zero()) : shape.vertices[vertex];
}

/// Returns the vertex of the core of a shape (the shape without its rounding) with the least scalar product with a
/// vector. The vector is given in the axes of the shape.
template <int Dim>
inline int lowest_vertex(const Shape<Dim>& shape, const Vec<Dim>& direction) {
  const Vec<Dim>* const vertices = shape.vertices.data();
  const int n = shape.n_vertices();
  if (n == 0) return 0;
  int lowest = 0;
  double least = vertices[0].dot(direction);
  for (int v = 1; v < n; ++v) {
    const double height = vertices[v].dot(direction);
    if (height < least) least = height, lowest = v;
  }
  return lowest;
}

/// Returns the largest scalar product of a unit vector with a point of a shape, for scale 1. The unit vector is given
/// in the axes of the shape.
template <int Dim>
inline double extent(const Shape<Dim>& shape, const Vec<Dim>& direction) {
  const Vec<Dim> furthest = core_vertex(shape, lowest_vertex<Dim>(shape, -direction));
  return furthest.dot(direction) + shape.rounding;
}

}  // namespace floc
