#pragma once

#include "floc/shape/polytope.h"

namespace floc {

/// Integrals over a body of density 1.
template <int Dim>
struct Moments {
  double volume = 0.0;
  Vec<Dim> first = Vec<Dim>::Zero();   ///< integral of x (length^(Dim + 1))
  Mat<Dim> second = Mat<Dim>::Zero();  ///< integral of x x' (length^(Dim + 2))

  Moments& operator+=(const Moments& other);
};

/// Moments of a convex polytope.
///
///   polygon:     sum over sides of triangles (0, a, b):        det/2, det/6 (a+b), det/24 (aa' + bb' + ss')
///   polyhedron:  sum over faces of tetrahedra (0, a, b, c):    det/6, det/24 (a+b+c), det/120 (aa' + bb' + cc' + ss')
///
/// with s the sum of the corners.
template <int Dim>
Moments<Dim> sharp_moments(const Polytope<Dim>& polytope);

/// Moments of the layer that rounding adds around a polytope: prisms on faces, sectors of cylinders along edges
/// and of balls at vertices, each in closed form. Their volumes are the terms of Steiner's formula.
template <int Dim>
Moments<Dim> rounding_moments(const Polytope<Dim>& polytope, double rounding);

/// Outward normal of a face, not of length one: twice its area in 3D (Newell), its length in 2D.
Vec<2> face_normal(const Polytope<2>& polytope, int face);
Vec<3> face_normal(const Polytope<3>& polytope, int face);

}  // namespace floc
