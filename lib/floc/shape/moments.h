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

/// Returns the moments of a convex polytope, as sums over triangles or tetrahedra that each have one corner at the
/// origin. With s the sum of the corners of a triangle or tetrahedron and det their determinant, the terms for the
/// volume, the first and the second moments are:
///
///   polygon:     sum over sides of triangles (0, a, b):        det/2, det/6 (a+b), det/24 (aa' + bb' + ss')
///   polyhedron:  sum over faces of tetrahedra (0, a, b, c):    det/6, det/24 (a+b+c), det/120 (aa' + bb' + cc' + ss')
template <int Dim>
Moments<Dim> sharp_moments(const Polytope<Dim>& polytope);

/// Returns the moments of the layer that rounding by the radius `rounding` adds around a polytope: prisms on faces,
/// sectors of cylinders along edges and sectors of balls at vertices, each in closed form. Their volumes are the terms
/// of Steiner's formula.
template <int Dim>
Moments<Dim> rounding_moments(const Polytope<Dim>& polytope, double rounding);

/// Returns an outward normal of a face. Its length is twice the area of the face in 3D (Newell's method), the
/// length of the side in 2D.
Vec<2> face_normal(const Polytope<2>& polytope, int face);
Vec<3> face_normal(const Polytope<3>& polytope, int face);

}  // namespace floc
