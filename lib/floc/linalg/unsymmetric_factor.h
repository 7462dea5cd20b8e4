#pragma once

#include <Eigen/SparseCore>
#include <memory>

namespace floc {

/// Sparse LU factor of a general square matrix (UMFPACK). The ordering depends on the pattern alone and is kept
/// while the pattern stays the same, so that a Newton iteration pays for it once and repeated runs give the
/// same bits.
class UnsymmetricFactor {
 public:
  UnsymmetricFactor();
  ~UnsymmetricFactor();
  UnsymmetricFactor(UnsymmetricFactor&&) noexcept;
  UnsymmetricFactor& operator=(UnsymmetricFactor&&) noexcept;

  /// Factorizes a square matrix (column-major; it is compressed and copied). Entries that are zero now but may
  /// not be later belong in the pattern.
  /// @return false when the matrix is singular to working precision or holds a value that is not finite;
  /// `solve` must then not be called.
  /// @throws std::runtime_error when memory runs out.
  [[nodiscard]] bool factorize(const Eigen::SparseMatrix<double>& matrix);

  /// Solves matrix * x = b, with iterative refinement.
  /// @pre the last factorize() returned true; b has as many rows as the matrix.
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

  /// Rough reciprocal condition number: smallest over largest pivot of the factor, 0 when singular.
  double reciprocal_condition() const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace floc
