#pragma once

#include <Eigen/SparseCore>
#include <memory>

namespace floc {

/// Sparse factor R of A = Q R (SuiteSparseQR), for systems A^T A x = b whose matrix must not be formed: the condition
/// number of R is the square root of that of A^T A.
class LeastSquaresFactor {
 public:
  /// Factorizes A (column-major; it is copied).
  /// @param rank_tolerance  length below which the part of a column that is orthogonal to the previous columns counts
  ///                        as zero; the column is then left out, and its unknown is zero in solutions
  /// @throws std::runtime_error if memory runs out
  LeastSquaresFactor(const Eigen::SparseMatrix<double>& matrix, double rank_tolerance);
  ~LeastSquaresFactor();
  LeastSquaresFactor(LeastSquaresFactor&&) noexcept;
  LeastSquaresFactor& operator=(LeastSquaresFactor&&) noexcept;

  /// Returns the number of columns of A that are not left out as dependent.
  int rank() const;

  /// Returns R^-1 R^-T b: the solution of A^T A x = b with zero for the unknowns of dependent columns. Its relative
  /// error is the rounding error times the condition number of R; refinement with A reduces it.
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

}  // namespace floc
