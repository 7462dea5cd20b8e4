#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "floc/linalg/elimination_order.h"

namespace floc {

/// Cost of a Cholesky factorization, predicted from the pattern of the matrix alone.
struct FactorCost {
  double bytes = 0.0;  ///< size of the factor (bytes); most of the memory of a factorization is for the factor
  double operations = 0.0;  ///< number of floating-point operations of one factorization
};

/// Sparse Cholesky factor of a symmetric matrix A (CHOLMOD). A may be positive definite or indefinite; both kinds are
/// factorized by supernodes, at the same speed. An indefinite A is not an error, and its negative eigenvalues can be
/// counted. The unknowns should be scaled so that the diagonal of A is of order one, because the smallest pivot and the
/// shifts are fixed numbers.
class SymmetricFactor {
 public:
  explicit SymmetricFactor(Ordering ordering = Ordering::automatic);
  ~SymmetricFactor();
  SymmetricFactor(SymmetricFactor&&) noexcept;
  SymmetricFactor& operator=(SymmetricFactor&&) noexcept;

  /// Sets the matrix A. If A has the same pattern as the previous matrix, the ordering and the symbolic factor are
  /// kept.
  /// @param lower  lower triangle of A, column-major; entries above the diagonal are ignored
  /// @param group  number of the group (grain) to which each unknown belongs, ascending from 0. The unknowns of a group
  ///               are placed together in the elimination order. This makes the search for an order faster by the
  ///               square of the group size, and no sparsity of the factor is lost. If `group` is empty, each unknown
  ///               forms a group
  /// @throws std::runtime_error if memory runs out
  void set_matrix(const Eigen::SparseMatrix<double>& lower, const std::vector<int>& group = {});

  /// Predicts the cost of factorize_positive(), which is also the cost of factorize_indefinite(). Only the symbolic
  /// analysis is made; its result is kept for the factorization. No memory is allocated for the factor.
  FactorCost predicted_cost();

  /// Factorizes A + shift * 1 as L L^T.
  /// @return false if A + shift * 1 is not positive definite to working precision
  [[nodiscard]] bool factorize_positive(double shift = 0.0);

  /// Factorizes A + shift * 1 as L S L^T without pivoting, where S is diagonal with entries 1 and -1. The matrix may be
  /// definite or indefinite.
  /// @return false if A is not finite
  [[nodiscard]] bool factorize_indefinite(double shift = 0.0);

  /// Returns the number of eigenvalues of A below `bound`. By Sylvester's law of inertia, it is the number of negative
  /// entries of the diagonal matrix S in A - bound * 1 = L S L^T. This factorization replaces the last factorization.
  /// The distance between `bound` and any eigenvalue should be larger than the error of the eigenvalues, which is a few
  /// rounding units.
  int count_eigenvalues_below(double bound);

  /// Solves A X = B by the last factor, with iterative refinement. If A + shift * 1 was factorized, the refinement is
  /// the proximal-point iteration. For a singular positive semidefinite A, this iteration converges if B is in the
  /// range of A.
  /// @param max_refinements  largest number of refinement steps; the refinement ends earlier if the residual stops
  ///                         decreasing
  /// @pre the last factorization succeeded
  Eigen::MatrixXd solve(const Eigen::MatrixXd& B, int max_refinements = 3) const;

  /// Returns the largest absolute row sum of A.
  double norm() const;

  /// Returns A * X.
  Eigen::MatrixXd multiply(const Eigen::MatrixXd& X) const;

  /// Estimates the condition number, in the 1-norm, of the matrix A + shift * 1 that was factorized last (Hager's
  /// method). The estimate is a lower bound. It is seldom too low by more than a factor of 3.
  /// @pre the last factorization succeeded
  double condition_estimate() const;

  /// Returns a rough reciprocal condition number of the matrix that was factorized last: the smallest absolute value of
  /// a pivot divided by the largest; 1 for an empty matrix. For a positive definite matrix this is an upper bound on
  /// the reciprocal condition number.
  /// @pre the last factorization succeeded
  double reciprocal_condition() const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

}  // namespace floc
