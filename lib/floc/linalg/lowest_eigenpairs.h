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

/// Finds the lowest eigenvalues and their vectors by Lanczos' method on the inverse of A + s * 1 (Spectra,
/// shift and invert), with a positive shift s that makes it positive definite. Eigenvalues that the inertia of
/// A shows to be missing are searched for again, in the space orthogonal to the vectors already found.
///
/// @param factor    holds A, with a diagonal of order one; the factor is replaced
/// @param left_out  independent null vectors of A, one column each, that the search leaves out
/// @param count     number of eigenvalues, > 0; fewer are returned if A has no more
/// Eigenvalues are accurate to a few units of rounding of A's norm.
/// @throws std::runtime_error if A has no Cholesky factor at any shift (not finite).
[[nodiscard]] Eigenpairs lowest_eigenpairs(SymmetricFactor& factor, const Eigen::SparseMatrix<double>& left_out,
                                           int count);

}  // namespace floc
