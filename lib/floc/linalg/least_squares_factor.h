#pragma once

#include <Eigen/SparseCore>
#include <memory>

namespace floc {

/// Sparse R of A = Q R (SuiteSparseQR), for systems A^T A x = b whose matrix must not be formed: the condition
/// of R is the square root of that of A^T A.
class LeastSquaresFactor {
 public:
  /// Factorizes A (column-major; it is copied).
  /// @param rank_tolerance  a column that depends on those before it up to this length takes no part: its
  ///                        unknown stays zero
  /// @throws std::runtime_error when memory runs out.
  LeastSquaresFactor(const Eigen::SparseMatrix<double>& matrix, double rank_tolerance);
  ~LeastSquaresFactor();
  LeastSquaresFactor(LeastSquaresFactor&&) noexcept;
  LeastSquaresFactor& operator=(LeastSquaresFactor&&) noexcept;

  /// Number of columns that take part.
  int rank() const;

  /// Returns R^-1 R^-T b: the solution of A^T A x = b with the unknowns of dependent columns at zero. Its error
  /// is rounding times the condition of R; refinement against A reduces it.
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

}  // namespace floc
