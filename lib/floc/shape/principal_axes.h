#pragma once

#include "floc/base/vec.h"

namespace floc {

/// Returns the principal axes of a symmetric matrix, such as the second moments of a body, as the columns of a rotation
/// matrix (determinant 1). They are computed by Jacobi rotations.
///
/// If the matrix is diagonal to 1e-13 of its trace, the axes are the coordinate axes; a cube, for example, is not
/// rotated. Equal moments cause no rotation. The axes are not sorted by the size of the moments.
Mat<3> principal_axes(Mat<3> matrix);

}  // namespace floc
