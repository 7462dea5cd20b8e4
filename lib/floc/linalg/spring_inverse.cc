#include "floc/linalg/spring_inverse.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "floc/base/infinity.h"
#include "floc/linalg/condition.h"
#include "floc/linalg/least_squares_factor.h"

namespace floc {
namespace {

/// If the condition number of the stiffness matrix is above this number, its Cholesky factor may hide a mechanism.
constexpr double kSuspiciousCondition = 1e12;
/// Tolerances of the factorization of sqrt(k) A by SuiteSparseQR, tried one after another until the factor is accurate.
/// Consider the component of a column of sqrt(k) A that is orthogonal to the previous columns, divided by the norm of
/// sqrt(k) A. The column counts as a mechanism if the length of this component is below the tolerance. For a mechanism,
/// rounding gives this component a length of 1e-15, or more if many columns are nearly dependent. For the softest chain
/// of springs that double precision resolves, the component is longer than the first tolerance.
constexpr double kDependent[] = {1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8};
/// Bound on the relative rounding error of the triangular factor R of sqrt(k) A = Q R: each entry of R is a sum of some
/// tens of products.
constexpr double kFactorRounding = 100.0 * std::numeric_limits<double>::epsilon();
/// Hager's estimate of a norm is a lower bound, but seldom too low by more than this factor. Multiplied by this factor,
/// the estimate serves as an upper bound.
constexpr double kEstimateMargin = 3.0;

std::function<Eigen::VectorXd(const Eigen::VectorXd&)> by(const SymmetricFactor& factor) {
  return [&factor](const Eigen::VectorXd& b) -> Eigen::VectorXd { return factor.solve(b, 0); };
}

/// Returns whether every column of `root` is, within rounding, a linear combination of the columns that `qr` has kept.
/// If so, the columns that `qr` has left out are mechanisms and not soft springs.
/// @param root  sqrt(k) A, the square root of the stiffness matrix
bool spans(const Eigen::SparseMatrix<double>& root, const LeastSquaresFactor& qr) {
  constexpr double kRounding = 1e-14, kLargest = 1e6;
  Eigen::VectorXd motion(root.cols());
  for (Eigen::Index c = 0; c < motion.size(); ++c) motion[c] = std::sin(1.0 + static_cast<double>(c));
  const Eigen::VectorXd stretch = root * motion;
  Eigen::VectorXd same = qr.solve(root.transpose() * stretch);
  same += qr.solve(root.transpose() * (stretch - root * same));
  const double left = (stretch - root * same).lpNorm<Eigen::Infinity>();
  const double size = 1.0 + same.lpNorm<Eigen::Infinity>();
  return size < kLargest && left <= kRounding * size * std::sqrt(static_cast<double>(root.cols()));
}

SpringInverse invert_root(const SymmetricFactor& factor, const SpringSystem& springs, double mechanism_length) {
  const Eigen::SparseMatrix<double> root = springs.stiffness.cwiseSqrt().asDiagonal() * springs.on_free;
  SpringInverse out;
  for (const double resolved : kDependent) {
    if (resolved != kDependent[0] && resolved <= mechanism_length)
      continue;  // this tolerance would repeat the first factorization
    const double dependent = std::max(resolved, mechanism_length);
    const auto qr = std::make_shared<LeastSquaresFactor>(root, dependent * std::sqrt(factor.norm()));
    if (resolved != kDependent[0] && !spans(root, *qr)) break;
    out.n_mechanisms = static_cast<int>(root.cols()) - qr->rank();
    out.inverse.apply = [qr](const Eigen::VectorXd& b) { return qr->solve(b); };
    const double condition =
        kEstimateMargin * factor.norm() * inverse_norm_estimate(root.cols(), out.inverse.apply);
    out.inverse.smallest_ratio = kFactorRounding * std::sqrt(condition) < 0.5 ? 0.5 : 0.0;
    out.condition = out.n_mechanisms > 0 ? kInfinity : condition;
    if (out.inverse.smallest_ratio > 0.0) break;
  }
  return out;
}

/// Inverts the indefinite matrix K in `factor` without adding a shift to its diagonal.
/// @return no value if K has no negative eigenvalue, or if the absolute value of an eigenvalue may be below `bound`
std::optional<SpringInverse> invert_indefinite(SymmetricFactor& factor, double bound) {
  // safety factor, larger than the error of any estimate of a condition number
  constexpr double kFarFromZero = 1e3;
  SpringInverse out;
  out.n_negative = factor.count_eigenvalues_below(0.0);
  out.condition = factor.condition_estimate();
  if (out.n_negative == 0 || !(kFarFromZero * bound * out.condition < factor.norm())) return std::nullopt;
  out.inverse.apply = by(factor);
  out.inverse.definite = false;
  out.inverse.inverse_norm = kEstimateMargin * out.condition / factor.norm();
  return out;
}

SpringInverse invert_shifted(SymmetricFactor& factor, double bound) {
  if (std::optional<SpringInverse> inverse = invert_indefinite(factor, bound)) return std::move(*inverse);
  SpringInverse out;
  out.n_negative = factor.count_eigenvalues_below(-bound);
  out.n_mechanisms = factor.count_eigenvalues_below(bound) - out.n_negative;
  const double shift = out.n_mechanisms > 0 ? 10.0 * bound : 0.0;
  out.inverse.apply = by(factor);
  out.inverse.definite = out.n_negative == 0 && factor.factorize_positive(shift);
  const bool factorized = out.inverse.definite || factor.factorize_indefinite(shift);
  out.condition = out.n_mechanisms > 0 || !factorized ? kInfinity : factor.condition_estimate();
  // The eigenvalues of the stiffness matrix, except the eigenvalues of mechanisms, exceed `bound`. The factor 0.5
  // allows for rounding errors.
  if (out.inverse.definite)
    out.inverse.smallest_ratio = 0.5 * bound / (bound + shift);
  else
    out.inverse.inverse_norm = kEstimateMargin * out.condition / factor.norm();
  return out;
}

}  // namespace

std::optional<SpringInverse> invert_positive(SymmetricFactor& factor) {
  if (!factor.factorize_positive()) return std::nullopt;
  SpringInverse out;
  out.condition = factor.condition_estimate();
  if (!(out.condition < kSuspiciousCondition)) return std::nullopt;
  out.inverse.apply = by(factor);
  out.inverse.smallest_ratio = 0.5;
  return out;
}

SpringInverse invert_singular(SymmetricFactor& factor, const SpringSystem& springs, double mechanism_bound,
                              double mechanism_length) {
  const bool has_root = springs.stiffness.size() == 0 || springs.stiffness.minCoeff() >= 0.0;
  return has_root ? invert_root(factor, springs, mechanism_length) : invert_shifted(factor, mechanism_bound);
}

}  // namespace floc
