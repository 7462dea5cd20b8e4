#pragma once

#include "floc/base/vec.h"

namespace floc {

/// Returns p q^-1 for two upper triangular matrices, by substitution. If p and q are diagonal, the result is diagonal
/// with the entries p_aa/q_aa.
template <int Dim>
Mat<Dim> right_quotient(const Mat<Dim>& p, const Mat<Dim>& q) {
  Mat<Dim> x = Mat<Dim>::Zero();
  for (int a = 0; a < Dim; ++a)
    for (int b = a; b < Dim; ++b) {
      double rest = p(a, b);
      for (int c = a; c < b; ++c) rest -= x(a, c) * q(c, b);
      x(a, b) = rest / q(b, b);
    }
  return x;
}

/// Returns the product p q of two upper triangular matrices.
template <int Dim>
Mat<Dim> upper_product(const Mat<Dim>& p, const Mat<Dim>& q) {
  Mat<Dim> x = Mat<Dim>::Zero();
  for (int a = 0; a < Dim; ++a)
    for (int b = a; b < Dim; ++b)
      for (int c = a; c <= b; ++c) x(a, b) += p(a, c) * q(c, b);
  return x;
}

}  // namespace floc
