#pragma once

#include <Eigen/SparseCore>

#include "floc/linalg/symmetric_factor.h"

namespace floc {

/// Lowest eigenvalues of a symmetric matrix, and their eigenvectors.
struct Eigenpairs {
  Eigen::VectorXd values;   ///< eigenvalues, ascending
  Eigen::MatrixXd vectors;  ///< eigenvectors as orthonormal columns, in the order of `values`
  /// Whether `values` contains all eigenvalues of the matrix up to the last entry of `values`, and multiple eigenvalues
  /// as often as they occur. Lanczos' method alone may miss some of several equal eigenvalues. The true number follows
  /// from Sylvester's law of inertia.
  bool complete = true;
};

/// Finds the lowest eigenvalues of a symmetric matrix A and their eigenvectors by Lanczos' method (Spectra). The method
/// is applied to the inverse of A + s * 1, where the shift s > 0 makes A + s * 1 positive definite. If the inertia of A
/// shows that eigenvalues have been missed, the search is repeated, orthogonal to the eigenvectors found so far. The
/// error of an eigenvalue is a few rounding units times the norm of A.
///
/// @param factor    contains A, whose diagonal must be of order one; the present factorization in `factor` is lost
/// @param left_out  linearly independent null vectors of A, one per column, that the search leaves out
/// @param count     number of eigenvalues to find, > 0; fewer are returned if A has fewer
/// @throws std::runtime_error if A + s * 1 has no Cholesky factor for any s, because A is not finite
[[nodiscard]] Eigenpairs lowest_eigenpairs(SymmetricFactor& factor, const Eigen::SparseMatrix<double>& left_out,
                                           int count);

}  // namespace floc
