#pragma once

#include <optional>

#include "floc/linalg/condensation.h"
#include "floc/linalg/symmetric_factor.h"

namespace floc {

/// Inverse of the stiffness matrix K = A^T k A of a SpringSystem, and the condition number and the inertia of K.
struct SpringInverse {
  /// approximate inverse of K; it may refer to the factor of K, which must exist as long as the inverse
  ApproximateInverse inverse;
  double condition = 1.0;  ///< estimated condition number of K; infinite if there are mechanisms
  int n_negative = 0;      ///< number of negative eigenvalues of K
  int n_mechanisms = 0;    ///< number of zero eigenvalues of K (mechanisms)
};

/// Inverts the stiffness matrix K by a Cholesky factor.
/// @param factor  contains K; the returned inverse refers to it
/// @return no value if K has no Cholesky factor, or if the condition number of K exceeds 1e12. In the second case, the
/// factor may hide a mechanism and is too inaccurate for error bounds
std::optional<SpringInverse> invert_positive(SymmetricFactor& factor);

/// Inverts a stiffness matrix K = A^T k A for which invert_positive() fails.
/// 1. If no spring has a negative stiffness, SuiteSparseQR factorizes the square root sqrt(k) A of K instead of K. The
///    root has digits that K has lost by rounding, and its rank gives the number of mechanisms.
/// 2. If any spring has a negative stiffness, K is factorized as L S L^T. Eigenvalues of K between -mechanism_bound and
///    mechanism_bound count as mechanisms, and lower eigenvalues as negative. If K has mechanisms, a shift is added to
///    its diagonal.
///
/// @param factor           contains K; the returned inverse may refer to it
/// @param mechanism_bound   largest absolute eigenvalue of K that counts as zero
/// @param mechanism_length  In case 1, consider the component of a column of sqrt(k) A that is orthogonal to other
/// columns, divided by the norm of sqrt(k) A. If the length of this component is at most `mechanism_length`, the
/// unknown of the column counts as a mechanism. With 0, the unknown counts as a mechanism only if the component is a
/// rounding error.
SpringInverse invert_singular(SymmetricFactor& factor, const SpringSystem& springs, double mechanism_bound,
                              double mechanism_length = 0.0);

}  // namespace floc
