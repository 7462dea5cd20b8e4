#pragma once

#include <Eigen/Core>

namespace floc {

/// Decompositions of small dense matrices by the library Eigen. One source file instantiates all of Eigen's
/// decompositions, because each of them adds seconds to the compile time of a file.

/// Eigenvalues of a symmetric matrix in ascending order, and a matrix whose columns are the eigenvectors in this order.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

/// Returns the eigenvalues and eigenvectors of a symmetric matrix.
/// @param matrix  the matrix, of which only the lower triangle is read
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& matrix);
/// Returns the eigenvalues of a symmetric matrix in ascending order, without its eigenvectors.
/// @param matrix  the matrix, of which only the lower triangle is read
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& matrix);
/// Returns the eigenvalues of a symmetric tridiagonal matrix, in ascending order.
/// @param beside  the off-diagonal entries; their number is one less than the number of diagonal entries
Eigen::VectorXd tridiagonal_eigenvalues(const Eigen::VectorXd& diagonal, const Eigen::VectorXd& beside);

/// Returns the solution of a linear system with a symmetric matrix; the matrix may be indefinite.
Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right_side);

/// Returns the vector x that minimises |columns x - y|; if there are several, the shortest.
Eigen::VectorXd least_squares_solution(const Eigen::MatrixXd& columns, const Eigen::VectorXd& y);

/// Returns a matrix with the first `count` vectors of an orthonormal basis of the whole space. The first columns.cols()
/// vectors of this basis span the same space as the columns of the argument.
Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& columns, Eigen::Index count);

/// Least-squares solution x = R^-1 Q^T y of the system A x = y, and the matrix R^-1. Here, A = Q R is the factorization
/// by Householder reflections, in which Q has orthonormal columns and R is upper triangular.
/// @pre the columns of A are linearly independent
struct LinearSystemByQr {
  Eigen::VectorXd solution;
  Eigen::MatrixXd inverse_of_r;
};
LinearSystemByQr solve_by_qr(const Eigen::MatrixXd& columns, const Eigen::VectorXd& y);

/// Result of a thin singular value decomposition: the singular values in descending order, and the matrix whose columns
/// are the right singular vectors.
struct SingularValues {
  Eigen::VectorXd values;
  Eigen::MatrixXd right;
};
SingularValues singular_values(const Eigen::MatrixXd& matrix);

}  // namespace floc
