#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "floc/linalg/elimination_order.h"

namespace floc {

/// Cost of a Cholesky factorization, predicted from the pattern of the matrix alone.
struct FactorCost {
  double bytes = 0.0;       ///< size of the factor, which takes most of the memory of the factorization (bytes)
  double operations = 0.0;  ///< number of floating-point operations of one factorization
};

/// Sparse Cholesky factor of a symmetric matrix A (CHOLMOD). A may be positive definite or indefinite; both are
/// factorized by supernodes at the same speed. An indefinite A is a result and not an error, and its negative
/// eigenvalues can be counted. The unknowns should be scaled so that the diagonal of A is of order one, because the
/// smallest pivot and the shifts are absolute numbers.
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
  ///               square of the size of a group, without a loss of sparsity. If empty, each unknown is a group of its
  ///               own
  /// @throws std::runtime_error if memory runs out
  void set_matrix(const Eigen::SparseMatrix<double>& lower, const std::vector<int>& group = {});

  /// Predicts the cost of factorize_positive(), which is also the cost of factorize_indefinite(). Only the symbolic
  /// analysis is made; it is kept for the factorization. The factor itself is not allocated.
  FactorCost predicted_cost();

  /// Factorizes A + shift * 1 as L L^T.
  /// @return false if A + shift * 1 is not positive definite to working precision
  [[nodiscard]] bool factorize_positive(double shift = 0.0);

  /// Factorizes A + shift * 1, definite or not, as L S L^T without pivoting, where S is diagonal with entries 1
  /// and -1.
  /// @return false if A is not finite
  [[nodiscard]] bool factorize_indefinite(double shift = 0.0);

  /// Returns the number of eigenvalues of A below `bound`. It is the number of negative entries of the diagonal matrix
  /// S in A - bound * 1 = L S L^T (Sylvester's law of inertia). This factorization replaces the last factorization.
  /// Rounding shifts the eigenvalues by a few rounding units; the distance of `bound` from any eigenvalue that matters
  /// should be larger.
  int count_eigenvalues_below(double bound);

  /// Solves A X = B by the last factor, with iterative refinement. If the factor is that of A + shift * 1, this is the
  /// proximal-point iteration, which converges for a singular positive semidefinite A if B lies in the range of A.
  /// @param max_refinements  largest number of refinement steps; the refinement ends earlier if the residual stops
  ///                         decreasing
  /// @pre the last factorization succeeded
  Eigen::MatrixXd solve(const Eigen::MatrixXd& B, int max_refinements = 3) const;

  /// Returns the largest absolute row sum of A.
  double norm() const;

  /// Returns A * X.
  Eigen::MatrixXd multiply(const Eigen::MatrixXd& X) const;

  /// Returns an estimate of the condition number, in the 1-norm, of the matrix A + shift * 1 that was factorized last
  /// (Hager's method). The estimate is a lower bound, seldom too low by more than a factor of 3.
  /// @pre the last factorization succeeded
  double condition_estimate() const;

  /// Returns a rough reciprocal condition number of the matrix that was factorized last: its smallest pivot divided by
  /// its largest pivot, both in absolute value; 1 for an empty matrix. For a positive definite matrix this is an upper
  /// bound on the reciprocal condition number.
  /// @pre the last factorization succeeded
  double reciprocal_condition() const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

}  // namespace floc
