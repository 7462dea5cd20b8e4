#pragma once

#include <Eigen/Core>

namespace floc {

/// Decompositions of small dense matrices by Eigen, compiled here once because each takes seconds to compile
/// wherever it is instantiated.

/// Eigenvalues, ascending, and the eigenvectors that belong to them, in columns.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

/// Returns the eigenvalues and eigenvectors of a symmetric matrix. @param matrix  its lower triangle is read
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& matrix);
/// Returns the eigenvalues of a symmetric matrix alone, ascending. @param matrix  its lower triangle is read
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& matrix);
/// Returns the eigenvalues of a symmetric tridiagonal matrix, ascending.
/// @param beside  the off-diagonal, one entry shorter than the diagonal
Eigen::VectorXd tridiagonal_eigenvalues(const Eigen::VectorXd& diagonal, const Eigen::VectorXd& beside);

/// Solves a symmetric system, definite or not.
Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right_side);

/// Returns the x that minimises |columns x - y|, and of several such x the one of least norm.
Eigen::VectorXd least_squares_solution(const Eigen::MatrixXd& columns, const Eigen::VectorXd& y);

/// Returns the first `count` columns of an orthonormal basis of the whole space, whose leading columns span the
/// given ones.
Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& columns, Eigen::Index count);

/// Solution R^-1 Q^T y of a system with A = Q R, by Householder reflections, and R^-1. @pre the columns are
/// independent
struct LinearSystemByQr {
  Eigen::VectorXd solution;
  Eigen::MatrixXd inverse_of_r;
};
LinearSystemByQr solve_by_qr(const Eigen::MatrixXd& columns, const Eigen::VectorXd& y);

/// Thin singular value decomposition: singular values, descending, and right singular vectors in columns.
struct SingularValues {
  Eigen::VectorXd values;
  Eigen::MatrixXd right;
};
SingularValues singular_values(const Eigen::MatrixXd& matrix);

}  // namespace floc
