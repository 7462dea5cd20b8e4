#pragma once

#include "floc/base/double_double.h"
#include "floc/geometry/cell.h"

namespace floc {

/// Point or vector whose coordinates are double-double numbers (unevaluated sums of two doubles). The rounding error of
/// a double is too large for stiff contacts. Let a be the grain diameter and F0 the pull-off force. At a distance of 40
/// a from the origin, the rounding error of a coordinate is 4e-15 a. This error changes the force of a contact with the
/// stiffness 1e9 F0/a by 4e-6 F0.
template <int Dim>
struct DoubleDoubleVec {
  DoubleDouble component[Dim];

  DoubleDouble& operator[](int a) { return component[a]; }
  const DoubleDouble& operator[](int a) const { return component[a]; }
};

template <int Dim>
DoubleDoubleVec<Dim> double_double(const Vec<Dim>& high, const Vec<Dim>& low) {
  DoubleDoubleVec<Dim> out;
  for (int a = 0; a < Dim; ++a) out[a] = exact_sum(high[a], low[a]);
  return out;
}

template <int Dim>
Vec<Dim> rounded(const DoubleDoubleVec<Dim>& v) {
  Vec<Dim> out;
  for (int a = 0; a < Dim; ++a) out[a] = v[a].rounded();
  return out;
}

/// Returns the periodic image of the point x that is displaced by `image` lattice vectors: x + image * cell.matrix.
template <int Dim>
DoubleDoubleVec<Dim> displaced(DoubleDoubleVec<Dim> x, const Cell<Dim>& cell, const Vec<Dim, int>& image) {
  for (int b = 0; b < Dim; ++b)
    if (image[b] != 0)
      for (int a = 0; a < Dim; ++a) x[a] = x[a] + exact_product(image[b], cell.matrix(b, a));
  return x;
}

template <int Dim>
DoubleDoubleVec<Dim> difference(const DoubleDoubleVec<Dim>& to, const DoubleDoubleVec<Dim>& from) {
  DoubleDoubleVec<Dim> r;
  for (int a = 0; a < Dim; ++a) r[a] = to[a] - from[a];
  return r;
}

/// Returns the gap (length) between the surfaces of two balls: |r| - (Ri + Rj) = (r^2 - (Ri + Rj)^2)/(|r| + Ri + Rj),
/// where r is the vector between their centres. The function computes the right-hand side with squares in double-double
/// arithmetic. The rounding error of the result is a few units in the last place of the gap. The error of |r| - (Ri +
/// Rj) would be larger: a unit in the last place of |r|.
template <int Dim>
double surface_gap(const DoubleDoubleVec<Dim>& r, double radius_i, double radius_j) {
  const DoubleDouble radii = exact_sum(radius_i, radius_j);
  DoubleDouble difference = -square(radii);
  for (int a = 0; a < Dim; ++a) difference = difference + square(r[a]);
  return difference.rounded() / (rounded<Dim>(r).norm() + radii.high);
}

}  // namespace floc
