#pragma once

#include "floc/base/vec.h"

namespace floc {

/// Returns the principal axes of a symmetric matrix, such as the second moments of a body. The axes are the columns of
/// a rotation matrix (determinant 1). Jacobi rotations are used.
///
/// If the matrix is diagonal to 1e-13 of its trace, the axes are the coordinate axes; a cube, for example, is not
/// rotated. Axes with equal moments are not rotated against each other. The axes are not sorted by the size of the
/// moments.
Mat<3> principal_axes(Mat<3> matrix);

}  // namespace floc
