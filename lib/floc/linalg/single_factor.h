#pragma once

#include <Eigen/SparseCore>
#include <memory>

namespace floc {

/// Cholesky factor in single precision of a symmetric positive semidefinite matrix A. It takes half the memory of a
/// factor in double precision, but has only 7 digits. Iterative refinement in double precision gives the other digits.
/// The factor is computed by Eigen, because CHOLMOD 3 has no single precision. Eigen does not use supernodes and
/// therefore factorizes a large matrix more slowly than a SymmetricFactor.
///
/// Rounding to single precision may make A indefinite. Increasing shifts are therefore added to the diagonal, until A +
/// shift * 1 has a Cholesky factor. The factor is inaccurate for motions whose stiffness is below the shift; the
/// refinement corrects the solution for these motions.
class SingleFactor {
 public:
  /// @param lower  lower triangle of A, with a diagonal of order one
  explicit SingleFactor(const Eigen::SparseMatrix<double>& lower);
  ~SingleFactor();
  SingleFactor(SingleFactor&&) noexcept;

  /// Returns whether A + shift * 1 has a Cholesky factor for one of the shifts that were tried, up to the size of the
  /// diagonal. If not, A is indefinite or not finite.
  bool positive() const { return positive_; }
  double shift() const { return shift_; }
  /// Returns an approximation of A^-1 b, whose relative error is about 1e-7 times the condition number of A.
  /// @pre positive()
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
  bool positive_ = false;
  double shift_ = 0.0;
};

}  // namespace floc
