#include "floc/linalg/single_factor.h"

#include <Eigen/SparseCholesky>
#include <cassert>

namespace floc {
namespace {

/// Shifts that are added to the diagonal of a matrix, one after another, until the matrix is positive definite. The
/// smallest shift is the rounding error of single precision. Each further shift is kNextShift times larger. The largest
/// shift is of order one, like the diagonal.
constexpr float kSmallestShift = 1e-6F;
constexpr float kLargestShift = 1.0F;
constexpr float kNextShift = 10.0F;

}  // namespace

struct SingleFactor::Factor {
  Eigen::SimplicialLLT<Eigen::SparseMatrix<float>, Eigen::Lower, Eigen::AMDOrdering<int>> llt;
};

SingleFactor::SingleFactor(const Eigen::SparseMatrix<double>& lower) : factor_(std::make_unique<Factor>()) {
  if (lower.cols() == 0) {
    positive_ = true;
    return;
  }
  const Eigen::SparseMatrix<float> rounded = lower.cast<float>();
  factor_->llt.analyzePattern(rounded);
  for (float shift = kSmallestShift; shift <= kLargestShift && !positive_; shift *= kNextShift) {
    factor_->llt.setShift(shift);
    factor_->llt.factorize(rounded);
    positive_ = factor_->llt.info() == Eigen::Success;
    shift_ = shift;
  }
}
SingleFactor::~SingleFactor() = default;
SingleFactor::SingleFactor(SingleFactor&&) noexcept = default;

Eigen::VectorXd SingleFactor::solve(const Eigen::VectorXd& b) const {
  assert(positive_);
  // The right-hand side is scaled to order one. Without scaling, the forces of a nearly relaxed packing may be too
  // small for single precision.
  const double size = b.size() == 0 ? 0.0 : b.lpNorm<Eigen::Infinity>();
  if (!(size > 0.0)) return Eigen::VectorXd::Zero(b.size());
  return size * factor_->llt.solve((b / size).cast<float>()).cast<double>();
}

}  // namespace floc
