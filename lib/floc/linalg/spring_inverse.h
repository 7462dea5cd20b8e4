#pragma once

#include <optional>

#include "floc/linalg/condensation.h"
#include "floc/linalg/symmetric_factor.h"

namespace floc {

/// Inverse of the stiffness matrix K = A^T k A of the free unknowns of a SpringSystem, with the condition number and
/// inertia of K.
struct SpringInverse {
  ApproximateInverse inverse;  ///< may refer to the factor from which it was made, which must outlive it
  double condition = 1.0;      ///< estimated condition number of K; infinite if there are mechanisms
  int n_negative = 0;          ///< number of negative eigenvalues of K
  int n_mechanisms = 0;        ///< number of zero eigenvalues of K (mechanisms)
};

/// Inverts the stiffness matrix K by a Cholesky factor.
/// @param factor  contains K; the inverse refers to it
/// @return no value if K has no Cholesky factor, or if its condition number exceeds some 1e12: such a factor may hide a
///         mechanism and is too inaccurate for error bounds
std::optional<SpringInverse> invert_positive(SymmetricFactor& factor);

/// Inverts a stiffness matrix K for which invert_positive() fails. If no spring has a negative stiffness, K has a
/// square root sqrt(k) A, which keeps the digits that K has lost and shows mechanisms by its rank (SuiteSparseQR).
/// Otherwise K is factorized as L S L^T: eigenvalues within `mechanism_bound` of zero are counted as mechanisms, lower
/// ones as negative, and a shift regularises the mechanisms.
/// @param factor  contains K; the inverse may refer to it
SpringInverse invert_singular(SymmetricFactor& factor, const SpringSystem& springs, double mechanism_bound);

}  // namespace floc
