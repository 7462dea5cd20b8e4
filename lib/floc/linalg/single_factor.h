#pragma once

#include <Eigen/SparseCore>
#include <memory>

namespace floc {

/// Cholesky factor in single precision of a symmetric positive semidefinite matrix A. It takes half the memory of a
/// factor in double precision but has only 7 digits, which refinement in double precision compensates. CHOLMOD 3 has no
/// single precision, so the factor is Eigen's, without supernodes; a large factor takes longer than SymmetricFactor.
///
/// Rounding to single precision may make A indefinite, so the diagonal is shifted by the smallest of several shifts for
/// which A + shift * 1 has a Cholesky factor. Refinement has to find motions softer than the shift.
class SingleFactor {
 public:
  /// @param lower  lower triangle of A, with a diagonal of order one
  explicit SingleFactor(const Eigen::SparseMatrix<double>& lower);
  ~SingleFactor();
  SingleFactor(SingleFactor&&) noexcept;

  /// Returns whether A + shift * 1 has been factorized. If no shift up to the size of the diagonal suffices, A is
  /// indefinite or not finite.
  bool positive() const { return positive_; }
  double shift() const { return shift_; }
  /// Returns an approximation of A^-1 b, whose relative error is about 1e-7 times the condition number. @pre positive()
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
  bool positive_ = false;
  double shift_ = 0.0;
};

}  // namespace floc
