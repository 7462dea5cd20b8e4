#pragma once

#include <Eigen/SparseCore>
#include <memory>

namespace floc {

/// Sparse LU factor of a general square matrix (UMFPACK). The ordering depends only on the pattern of the matrix and is
/// kept as long as the pattern does not change. One ordering therefore serves all steps of a Newton iteration, and
/// repeated runs give the same bits.
class UnsymmetricFactor {
 public:
  UnsymmetricFactor();
  ~UnsymmetricFactor();
  UnsymmetricFactor(UnsymmetricFactor&&) noexcept;
  UnsymmetricFactor& operator=(UnsymmetricFactor&&) noexcept;

  /// Factorizes a square matrix.
  /// @param matrix  column-major; it is compressed and copied. Its pattern should include entries that are zero now but
  ///                may become nonzero, so that the ordering can be kept
  /// @return false if the matrix is singular to working precision or contains a value that is not finite; solve() must
  ///         then not be called
  /// @throws std::runtime_error if memory runs out
  [[nodiscard]] bool factorize(const Eigen::SparseMatrix<double>& matrix);

  /// Solves matrix * x = b by the last factor, with iterative refinement.
  /// @pre the last factorize() returned true; b has as many rows as the matrix
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

  /// Returns a rough reciprocal condition number of the matrix: the smallest pivot divided by the largest pivot; 0 if
  /// the matrix is singular.
  double reciprocal_condition() const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace floc
