#pragma once

#include <Eigen/SparseCore>

#include "floc/linalg/symmetric_factor.h"

namespace floc {

/// Lowest eigenvalues of a symmetric matrix and their eigenvectors.
struct Eigenpairs {
  Eigen::VectorXd values;   ///< eigenvalues, ascending
  Eigen::MatrixXd vectors;  ///< eigenvectors as orthonormal columns, in the order of `values`
  /// Whether every eigenvalue below the last one is included, verified by Sylvester's law of inertia. Lanczos' method
  /// alone may miss copies of a multiple eigenvalue.
  bool complete = true;
};

/// Finds the lowest eigenvalues of a symmetric matrix A and their eigenvectors by Lanczos' method on the inverse of A +
/// s * 1 (Spectra, shift and invert), with a positive shift s that makes A + s * 1 positive definite. If the inertia of
/// A shows that eigenvalues are missing, they are searched for again, in the space orthogonal to the vectors already
/// found. Eigenvalues are accurate to a few rounding units of the norm of A.
///
/// @param factor    contains A, with a diagonal of order one; its factorization is replaced
/// @param left_out  linearly independent null vectors of A, one per column, that the search leaves out
/// @param count     number of eigenvalues, > 0; fewer are returned if A has fewer
/// @throws std::runtime_error if A has no Cholesky factor at any shift (it is not finite)
[[nodiscard]] Eigenpairs lowest_eigenpairs(SymmetricFactor& factor, const Eigen::SparseMatrix<double>& left_out,
                                           int count);

}  // namespace floc
