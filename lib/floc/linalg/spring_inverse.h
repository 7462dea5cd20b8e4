#pragma once

#include <optional>

#include "floc/linalg/condensation.h"
#include "floc/linalg/symmetric_factor.h"

namespace floc {

/// Inverse of the stiffness K = A^T k A of the free unknowns of springs, with the condition and inertia of K.
struct SpringInverse {
  ApproximateInverse inverse;  ///< may refer to the factor it was made with
  double condition = 1.0;      ///< estimate for K; infinite with mechanisms
  int n_negative = 0;          ///< eigenvalues of K below zero
  int n_mechanisms = 0;        ///< vanishing eigenvalues of K
};

/// Inverts K by a Cholesky factor. Returns nothing where there is none, or where the condition number exceeds
/// some 1e12: such a factor may hide a mechanism, and is too inaccurate for error bounds.
/// @param factor  holds K; `inverse` refers to it
std::optional<SpringInverse> invert_positive(SymmetricFactor& factor);

/// Inverts a K on which invert_positive() fails. Without negative stiffnesses K has a square root sqrt(k) A,
/// which keeps the digits that K has lost and shows mechanisms by its rank (SuiteSparseQR). Otherwise K is
/// factorized as L S L^T: eigenvalues within `mechanism_bound` of zero are counted as mechanisms, those below
/// as negative, and a shift regularises the mechanisms.
/// @param factor  holds K; `inverse` may refer to it
SpringInverse invert_singular(SymmetricFactor& factor, const SpringSystem& springs, double mechanism_bound);

}  // namespace floc
