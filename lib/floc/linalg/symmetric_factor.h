#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "floc/linalg/elimination_order.h"

namespace floc {

/// Cost of a Cholesky factor, known from the pattern of the matrix alone.
struct FactorCost {
  double bytes = 0.0;       ///< size of the factor, most of the memory held
  double operations = 0.0;  ///< floating-point operations of one factorization
};

/// Sparse Cholesky factor of a symmetric matrix A, given by its lower triangle (CHOLMOD). Positive definite
/// matrices are factorized by supernodes, others by the same supernodes at the same speed (factorize_signed()).
/// An indefinite matrix is a result, not an error, and its negative eigenvalues can be counted. The unknowns
/// should be scaled so that A has a diagonal of order one: pivots and shifts are absolute.
class SymmetricFactor {
 public:
  explicit SymmetricFactor(Ordering ordering = Ordering::automatic);
  ~SymmetricFactor();
  SymmetricFactor(SymmetricFactor&&) noexcept;
  SymmetricFactor& operator=(SymmetricFactor&&) noexcept;

  /// Sets A (lower triangle, column-major; entries above the diagonal are ignored). A matrix with the same
  /// pattern as the one before keeps its ordering and symbolic factors.
  /// @param group  of each unknown, ascending: unknowns of one group (a grain) are ordered together, which is
  ///               faster by the square of its size and just as good. Empty: each is its own.
  /// @throws std::runtime_error when memory runs out.
  void set_matrix(const Eigen::SparseMatrix<double>& lower, const std::vector<int>& group = {});

  /// Predicts the cost of factorize_positive() from the symbolic analysis, which is kept for the factorization.
  /// Nothing of the size of the factor is allocated. factorize_indefinite() costs as much.
  FactorCost predicted_cost();

  /// Factorizes A + shift * 1 as L L^T.
  /// @return false when it is not positive definite to working precision.
  [[nodiscard]] bool factorize_positive(double shift = 0.0);

  /// Factorizes A + shift * 1, definite or not, as L S L^T without pivoting, with entries 1 and -1 on the
  /// diagonal of S.
  /// @return false when A is not finite
  [[nodiscard]] bool factorize_indefinite(double shift = 0.0);

  /// Number of eigenvalues of A below `bound`, by Sylvester's law of inertia from the signs of S in
  /// A - bound * 1 = L S L^T. Exact for a matrix within a few units of rounding of A - bound * 1, so `bound`
  /// should stay further than that from the eigenvalues that matter. The factor it makes replaces any other.
  int count_eigenvalues_below(double bound);

  /// Solves A X = B by the last factor with iterative refinement against A. With a shift this is the
  /// proximal-point iteration, which converges for a singular positive semidefinite A if B lies in the range of
  /// A.
  /// @param max_refinements  stops earlier when the residual no longer falls
  /// @pre the last factorization succeeded.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& B, int max_refinements = 3) const;

  /// Returns the largest absolute row sum of A.
  double norm() const;

  /// Returns A * X.
  Eigen::MatrixXd multiply(const Eigen::MatrixXd& X) const;

  /// Estimates the condition number of A + shift in the 1-norm (Hager's method: a lower bound, seldom too low
  /// by more than a factor of 3).
  /// @pre the last factorization succeeded.
  double condition_estimate() const;

  /// Returns a rough reciprocal condition number: smallest over largest pivot of the last factor in absolute
  /// value, 1 for an empty matrix. It is an upper bound of the reciprocal condition of a positive definite
  /// matrix.
  /// @pre the last factorization succeeded.
  double reciprocal_condition() const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

}  // namespace floc
