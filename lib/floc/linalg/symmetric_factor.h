#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "floc/linalg/elimination_order.h"

namespace floc {

/// Cost of a Cholesky factorization, predicted from the pattern of the matrix alone.
struct FactorCost {
  double bytes = 0.0;       ///< size of the factor, which is most of the memory used
  double operations = 0.0;  ///< floating-point operations of one factorization
};

/// Sparse Cholesky factor of a symmetric matrix A, given by its lower triangle (CHOLMOD). Positive definite matrices
/// are factorized by supernodes, indefinite ones by the same supernodes at the same speed (factorize_signed()). An
/// indefinite matrix is a result, not an error, and its negative eigenvalues can be counted. The unknowns should be
/// scaled so that A has a diagonal of order one, because pivots and shifts are absolute.
class SymmetricFactor {
 public:
  explicit SymmetricFactor(Ordering ordering = Ordering::automatic);
  ~SymmetricFactor();
  SymmetricFactor(SymmetricFactor&&) noexcept;
  SymmetricFactor& operator=(SymmetricFactor&&) noexcept;

  /// Sets A (lower triangle, column-major; entries above the diagonal are ignored). If the pattern is the same as that
  /// of the previous matrix, the ordering and the symbolic factor are kept.
  /// @param group  group (grain) of each unknown, ascending; the unknowns of a group are ordered together, which is
  ///               faster by the square of the group's size and gives an equally sparse factor. If empty, each unknown
  ///               is a group
  /// @throws std::runtime_error if memory runs out
  void set_matrix(const Eigen::SparseMatrix<double>& lower, const std::vector<int>& group = {});

  /// Predicts the cost of factorize_positive() from the symbolic analysis, which is kept for the factorization. The
  /// factor itself is not allocated. factorize_indefinite() has the same cost.
  FactorCost predicted_cost();

  /// Factorizes A + shift * 1 as L L^T.
  /// @return false if the matrix is not positive definite to working precision
  [[nodiscard]] bool factorize_positive(double shift = 0.0);

  /// Factorizes A + shift * 1, definite or not, as L S L^T without pivoting, with entries 1 and -1 on the diagonal of
  /// S.
  /// @return false if A is not finite
  [[nodiscard]] bool factorize_indefinite(double shift = 0.0);

  /// Returns the number of eigenvalues of A below `bound`, by Sylvester's law of inertia: the number of negative signs
  /// of S in A - bound * 1 = L S L^T. The count is exact for a matrix that differs from A - bound * 1 by a few rounding
  /// units, so `bound` should be farther than that from any eigenvalue that matters. The factorization replaces the
  /// last one.
  int count_eigenvalues_below(double bound);

  /// Solves A X = B by the last factor with iterative refinement. With a shift this is the proximal-point iteration,
  /// which converges for a singular positive semidefinite A if B lies in the range of A.
  /// @param max_refinements  largest number of refinement steps; fewer are made if the residual no longer decreases
  /// @pre the last factorization succeeded
  Eigen::MatrixXd solve(const Eigen::MatrixXd& B, int max_refinements = 3) const;

  /// Returns the largest absolute row sum of A.
  double norm() const;

  /// Returns A * X.
  Eigen::MatrixXd multiply(const Eigen::MatrixXd& X) const;

  /// Returns an estimate of the condition number of A + shift * 1 in the 1-norm (Hager's method). It is a lower bound,
  /// seldom too low by more than a factor of 3.
  /// @pre the last factorization succeeded
  double condition_estimate() const;

  /// Returns a rough reciprocal condition number: the smallest pivot of the last factor over the largest one, in
  /// absolute value; 1 for an empty matrix. For a positive definite matrix it is an upper bound on the reciprocal
  /// condition number.
  /// @pre the last factorization succeeded
  double reciprocal_condition() const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

}  // namespace floc
