#pragma once

#include "floc/base/vec.h"

namespace floc {

/// Principal axes of a symmetric matrix by Jacobi's rotations, the columns of a rotation (determinant 1).
///
/// Axes are those given wherever the matrix is diagonal to 1e-13 of its trace, so that a cube keeps its own and
/// equal moments turn nothing; they are in no order of size.
Mat<3> principal_axes(Mat<3> matrix);

}  // namespace floc
