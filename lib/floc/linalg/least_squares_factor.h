#pragma once

#include <Eigen/SparseCore>
#include <memory>

namespace floc {

/// Sparse triangular factor R of a matrix A = Q R (SuiteSparseQR). With R, the system A^T A x = b is solved without
/// forming the matrix A^T A. Fewer digits are lost by rounding with R than with A^T A, because the condition number of
/// R is only the square root of the condition number of A^T A.
class LeastSquaresFactor {
 public:
  /// Factorizes A (column-major; it is copied).
  /// @param rank_tolerance  A column of A counts as linearly dependent if its component orthogonal to the previous
  ///                        columns is shorter than this tolerance. Such a column is left out, and its unknown is zero
  ///                        in solutions
  /// @throws std::runtime_error if memory runs out
  LeastSquaresFactor(const Eigen::SparseMatrix<double>& matrix, double rank_tolerance);
  ~LeastSquaresFactor();
  LeastSquaresFactor(LeastSquaresFactor&&) noexcept;
  LeastSquaresFactor& operator=(LeastSquaresFactor&&) noexcept;

  /// Returns the numerical rank of A: the number of columns that count as linearly independent.
  int rank() const;

  /// Returns R^-1 R^-T b, which is the solution of A^T A x = b. The unknowns of columns that were left out are zero.
  /// The relative error of the solution is the rounding error times the condition number of R. Iterative refinement
  /// with A reduces the error.
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

}  // namespace floc
