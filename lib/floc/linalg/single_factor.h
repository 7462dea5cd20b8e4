#pragma once

#include <Eigen/SparseCore>
#include <memory>

namespace floc {

/// Cholesky factor in single precision of a symmetric positive semidefinite matrix A: half the memory of one in
/// double, but only 7 digits, which refinement in double makes up for. CHOLMOD 3 has no single precision, so
/// this one is Eigen's, without supernodes: slower than SymmetricFactor where the factor is large.
///
/// A shift makes up for what rounding to single precision may take from the spectrum of A: the smallest of
/// those tried with which A + shift * 1 factorizes. Motions softer than the shift are found by the refinement.
class SingleFactor {
 public:
  /// @param lower  lower triangle of A, with a diagonal of order one
  explicit SingleFactor(const Eigen::SparseMatrix<double>& lower);
  ~SingleFactor();
  SingleFactor(SingleFactor&&) noexcept;

  /// False where no shift up to the size of the diagonal helps: A is indefinite, or not finite.
  bool positive() const { return positive_; }
  double shift() const { return shift_; }
  /// An approximation of A^-1 b, accurate to some 1e-7 times the condition number. @pre positive()
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
  bool positive_ = false;
  double shift_ = 0.0;
};

}  // namespace floc
