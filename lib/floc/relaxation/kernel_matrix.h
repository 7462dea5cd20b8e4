#pragma once

#include "floc/base/vec.h"

namespace floc {

/// Copies a matrix into a plain array, since kernels read matrices as plain arrays.
template <int Dim>
void copy_matrix(const Mat<Dim>& from, double (&to)[Dim][Dim]) {
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b) to[a][b] = from(a, b);
}

}  // namespace floc
