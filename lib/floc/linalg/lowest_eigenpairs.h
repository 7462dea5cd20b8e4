#pragma once

#include <Eigen/SparseCore>

#include "floc/linalg/symmetric_factor.h"

namespace floc {

/// Lowest eigenvalues of a symmetric matrix and their vectors.
struct Eigenpairs {
  Eigen::VectorXd values;   ///< ascending
  Eigen::MatrixXd vectors;  ///< orthonormal columns, in that order
  /// No eigenvalue below the last of these is missing, by Sylvester's law of inertia. Lanczos' method may miss
  /// copies of a multiple eigenvalue.
  bool complete = true;
};

/// Lanczos' method on the inverse of A + s * 1 (Spectra, shift and invert), s a positive shift that makes it
/// positive definite. Eigenvalues that the inertia of A shows to be missing are searched for again, with those
/// already found left out.
///
/// @param factor    its matrix is A, with a diagonal of order one; the factor is replaced
/// @param left_out  independent null vectors of A, one column each, that are not to be found again
/// @param count     how many, > 0; fewer come back if A has no more
/// Eigenvalues are accurate to a few units of rounding of A's norm.
/// @throws std::runtime_error if A has no Cholesky factor at any shift (not finite).
[[nodiscard]] Eigenpairs lowest_eigenpairs(SymmetricFactor& factor, const Eigen::SparseMatrix<double>& left_out,
                                           int count);

}  // namespace floc
