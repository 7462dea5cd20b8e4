#pragma once

#include "floc/shape/polytope.h"

namespace floc {

/// Integrals of 1, x and x x' (x' is the transpose of x) over the positions x in a body.
template <int Dim>
struct Moments {
  double volume = 0.0;
  Vec<Dim> first = Vec<Dim>::Zero();  ///< integral of the position x over the body (length^(Dim + 1))
  /// Integral of x x' over the body, where x is the position (length^(Dim + 2)).
  Mat<Dim> second = Mat<Dim>::Zero();

  Moments& operator+=(const Moments& other);
};

/// Returns the moments of a convex polytope. The moments are sums over triangles (2D) or tetrahedra (3D) with one
/// corner at the origin. Let det be the determinant of the other corners, and s the sum of the other corners. The terms
/// of the sums for the volume, the first moments and the second moments are:
///
///   polygon:     sum over sides of triangles (0, a, b):        det/2, det/6 (a+b), det/24 (aa' + bb' + ss')
///   polyhedron:  sum over faces of tetrahedra (0, a, b, c):    det/6, det/24 (a+b+c), det/120 (aa' + bb' + cc' + ss')
template <int Dim>
Moments<Dim> sharp_moments(const Polytope<Dim>& polytope);

/// Returns the moments of the layer that rounding by the radius `rounding` adds around a polytope: prisms on faces,
/// sectors of cylinders along edges, and sectors of balls at vertices. Each part has a closed formula. The volumes of
/// the parts are the terms of Steiner's formula.
template <int Dim>
Moments<Dim> rounding_moments(const Polytope<Dim>& polytope, double rounding);

/// Returns the moments of a rounded polytope: sharp_moments() and, if it is rounded, rounding_moments().
template <int Dim>
Moments<Dim> body_moments(const Polytope<Dim>& core, double rounding) {
  Moments<Dim> moments = sharp_moments(core);
  if (rounding > 0.0) moments += rounding_moments(core, rounding);
  return moments;
}

/// Returns an outward normal of a face. In 3D the length of the normal is twice the area of the face (Newell's method);
/// in 2D it is the length of the side.
Vec<2> face_normal(const Polytope<2>& polytope, int face);
Vec<3> face_normal(const Polytope<3>& polytope, int face);

}  // namespace floc
