#pragma once

#include <Eigen/SparseCore>
#include <memory>

namespace floc {

/// Cholesky factor in single precision of a symmetric positive semidefinite matrix A. It takes half the memory of a
/// factor in double precision. It has only 7 digits; iterative refinement in double precision makes up for this.
/// CHOLMOD 3 has no single precision, so Eigen computes the factor, without supernodes; for a large matrix this takes
/// longer than a SymmetricFactor.
///
/// Rounding to single precision may make A indefinite. Growing shifts are therefore added to its diagonal, until A +
/// shift * 1 has a Cholesky factor. Motions whose stiffness is below this shift are left to the refinement.
class SingleFactor {
 public:
  /// @param lower  lower triangle of A, with a diagonal of order one
  explicit SingleFactor(const Eigen::SparseMatrix<double>& lower);
  ~SingleFactor();
  SingleFactor(SingleFactor&&) noexcept;

  /// Returns whether a shift was found for which A + shift * 1 has a Cholesky factor. If not, A is indefinite or not
  /// finite, because shifts up to the size of its diagonal have been tried.
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
