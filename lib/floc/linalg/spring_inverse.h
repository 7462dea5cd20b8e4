#pragma once

#include <optional>

#include "floc/linalg/condensation.h"
#include "floc/linalg/symmetric_factor.h"

namespace floc {

/// An inverse of the stiffness K = A^T k A of the free unknowns of springs, and what was learnt of K on the
/// way.
struct SpringInverse {
  ApproximateInverse inverse;  ///< may refer to the factor it was made with
  double condition = 1.0;      ///< estimate for K; infinite with mechanisms
  int n_negative = 0;          ///< eigenvalues of K below zero
  int n_mechanisms = 0;        ///< vanishing eigenvalues of K
};

/// By Cholesky's factor of K, if there is one that can be trusted. One that succeeds on a K of a condition
/// beyond some 1e12 cannot: it may hide a mechanism, and is too inaccurate to bound errors with.
/// @param factor  holds K; `inverse` refers to it
std::optional<SpringInverse> invert_positive(SymmetricFactor& factor);

/// For a K on which invert_positive() fails. Springs without negative stiffness have a square root sqrt(k) A,
/// which keeps the digits that K has lost and shows mechanisms by its rank (SuiteSparseQR). Else by L D L^T:
/// eigenvalues within `mechanism_bound` of zero are counted as mechanisms, those below as negative, and a shift
/// regularises the first.
/// @param factor  holds K; `inverse` may refer to it
SpringInverse invert_singular(SymmetricFactor& factor, const SpringSystem& springs, double mechanism_bound);

}  // namespace floc
