#pragma once

#include "floc/base/two_part.h"
#include "floc/geometry/cell.h"

namespace floc {

/// A place whose coordinates are kept in two parts: an absolute double alone resolves half a unit in its last
/// place, which a stiff contact feels (at 40 a from the origin 4e-15 a: 4e-6 F0 at kappa = 1e9).
template <int Dim>
struct TwoPartVec {
  TwoPart component[Dim];

  TwoPart& operator[](int a) { return component[a]; }
  const TwoPart& operator[](int a) const { return component[a]; }
};

template <int Dim>
TwoPartVec<Dim> two_part(const Vec<Dim>& high, const Vec<Dim>& low) {
  TwoPartVec<Dim> out;
  for (int a = 0; a < Dim; ++a) out[a] = exact_sum(high[a], low[a]);
  return out;
}

template <int Dim>
Vec<Dim> rounded(const TwoPartVec<Dim>& v) {
  Vec<Dim> out;
  for (int a = 0; a < Dim; ++a) out[a] = v[a].rounded();
  return out;
}

/// x displaced to an image: x + image * cell.matrix.
template <int Dim>
TwoPartVec<Dim> displaced(TwoPartVec<Dim> x, const Cell<Dim>& cell, const Vec<Dim, int>& image) {
  for (int b = 0; b < Dim; ++b)
    if (image[b] != 0)
      for (int a = 0; a < Dim; ++a) x[a] = x[a] + exact_product(image[b], cell.matrix(b, a));
  return x;
}

template <int Dim>
TwoPartVec<Dim> difference(const TwoPartVec<Dim>& to, const TwoPartVec<Dim>& from) {
  TwoPartVec<Dim> r;
  for (int a = 0; a < Dim; ++a) r[a] = to[a] - from[a];
  return r;
}

/// Gap between two round surfaces, |r| - (Ri + Rj) = (r^2 - (Ri + Rj)^2)/(|r| + Ri + Rj): the second form, with
/// squares in two parts, is right to a few units in the last place of the gap itself, not of the distance.
template <int Dim>
double surface_gap(const TwoPartVec<Dim>& r, double radius_i, double radius_j) {
  const TwoPart radii = exact_sum(radius_i, radius_j);
  TwoPart difference = -square(radii);
  for (int a = 0; a < Dim; ++a) difference = difference + square(r[a]);
  return difference.rounded() / (rounded<Dim>(r).norm() + radii.high);
}

}  // namespace floc
