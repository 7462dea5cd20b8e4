#pragma once

#include <Eigen/SparseCore>
#include <memory>

namespace floc {

/// Sparse triangular factor R of a matrix A = Q R (SuiteSparseQR). It solves A^T A x = b without forming A^T A. The
/// condition number of R is only the square root of that of A^T A, and rounding therefore costs fewer digits.
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

  /// Returns the numerical rank of A: the number of columns that were not left out as dependent.
  int rank() const;

  /// Returns R^-1 R^-T b: the solution of A^T A x = b with zero for the unknowns of columns that were left out. The
  /// relative error of the solution is the rounding error times the condition number of R; iterative refinement with A
  /// reduces it.
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

}  // namespace floc
