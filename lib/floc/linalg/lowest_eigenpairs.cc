#include "floc/linalg/lowest_eigenpairs.h"

#include <Spectra/SymEigsShiftSolver.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>

#include "floc/base/dense_solvers.h"

namespace floc {
namespace {

/// Smallest shift of the diagonal that is tried to make a matrix positive definite. If the entries of the matrix are of
/// order one, this shift is far above the rounding error. It is below all eigenvalues except the eigenvalues of
/// mechanisms.
constexpr double kFirstShift = 1e-10;
/// Largest shift of the diagonal that is tried to make a matrix positive definite.
constexpr double kLastShift = 1e6;
/// Lanczos' iteration ends when the relative change of the eigenvalues of the inverse is below this value. The relative
/// error of an eigenvalue is then about this value. The error of an eigenvector is the square root of this value,
/// divided by the relative distance between the eigenvalue and the next eigenvalue.
constexpr double kConverged = 1e-11;
/// Limit on the number of restarts of the Lanczos iteration.
constexpr int kMaxRestarts = 300;
/// Rounding does not change the inertia of A - b * 1 if every eigenvalue of A differs from the number b by more than
/// this value.
constexpr double kClear = 1e-13;
/// Matrices up to this order are small: a dense solver computes their eigenpairs in negligible time.
constexpr int kDense = 120;

/// Projector onto the space that is orthogonal to the columns of two matrices, a sparse and a dense one.
class Projector {
 public:
  explicit Projector(const Eigen::SparseMatrix<double>& sparse) : sparse_(sparse) {
    if (sparse.cols() > 0) gram_.compute(Eigen::SparseMatrix<double>(sparse.transpose() * sparse));
  }
  void take_out(const Eigen::MatrixXd& orthonormal) { dense_ = orthonormal; }

  Eigen::VectorXd operator()(Eigen::VectorXd x) const {
    for (int pass = 0; pass < 2; ++pass) {  // the second pass removes the rounding error of the first
      if (sparse_.cols() > 0) x -= sparse_ * gram_.solve(Eigen::VectorXd(sparse_.transpose() * x));
      if (dense_.cols() > 0) x -= dense_ * (dense_.transpose() * x);
    }
    return x;
  }

 private:
  const Eigen::SparseMatrix<double>& sparse_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> gram_;
  Eigen::MatrixXd dense_;
};

/// Operator P (A + s * 1)^-1 P, where P is the projector, in the form that Spectra requires. The matrix A and the shift
/// s are in `factor`.
struct ShiftInvert {
  using Scalar = double;
  const SymmetricFactor& factor;
  const Projector& project;
  Eigen::Index n;

  Eigen::Index rows() const { return n; }
  Eigen::Index cols() const { return n; }
  void set_shift(double) {}  // the factor already includes the shift
  void perform_op(const double* in, double* out) const {
    const Eigen::VectorXd x = project(Eigen::Map<const Eigen::VectorXd>(in, n));
    Eigen::Map<Eigen::VectorXd>(out, n) = project(factor.solve(x, 0));
  }
};

double make_positive(SymmetricFactor& factor) {
  for (double shift = kFirstShift; shift < kLastShift; shift *= 10.0)
    if (factor.factorize_positive(shift)) return shift;
  throw std::runtime_error(
      "the modes cannot be computed, probably because the stiffness matrix contains values that are not "
      "finite");
}

/// Returns up to `count` eigenpairs of the matrix in `factor`, in ascending order of the eigenvalues. The eigenvectors
/// are orthogonal to the vectors that the projector removes.
Eigenpairs search(const SymmetricFactor& factor, const Projector& project, double shift, Eigen::Index n,
                  int count) {
  ShiftInvert op{factor, project, n};
  const Eigen::Index basis = std::min<Eigen::Index>(n, std::max(2 * count + 20, 40));
  Spectra::SymEigsShiftSolver<ShiftInvert> solver(op, count, basis, -shift);
  // The entries of the start vector must have no symmetry. Otherwise, in a lattice, the start vector could be
  // orthogonal to some modes, and the search would miss them.
  Eigen::VectorXd start(n);
  for (Eigen::Index k = 0; k < n; ++k) start[k] = std::sin(1.0 + 1.7 * static_cast<double>(k % 100003));
  start = project(start);
  solver.init(start.data());
  solver.compute(Spectra::SortRule::LargestMagn, kMaxRestarts, kConverged, Spectra::SortRule::SmallestAlge);
  Eigenpairs found;
  found.values = solver.eigenvalues();
  found.vectors = solver.eigenvectors();
  return found;
}

/// Returns the Rayleigh-Ritz approximations to eigenpairs of the matrix in `factor`, within the span of `vectors`.
Eigenpairs best_in_span(const SymmetricFactor& factor, const Eigen::MatrixXd& vectors) {
  const Eigen::MatrixXd q = orthonormal_basis(vectors, vectors.cols());
  const SymmetricEigen eigen = symmetric_eigen(q.transpose() * factor.multiply(q));
  return {eigen.values, q * eigen.vectors, true};
}

/// Returns up to `count` vectors v for which A v is zero to rounding, where A is the matrix in `factor`. All these
/// vectors are eigenvectors of the eigenvalue zero; a Lanczos search would find only one of them. The inverse of A +
/// shift * 1 multiplies each null vector by the large number 1/shift, so that a few products with the inverse separate
/// the null vectors from all others.
Eigenpairs search_null_space(const SymmetricFactor& factor, const Projector& project, Eigen::Index n,
                             int count) {
  constexpr int kPasses = 2;
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  Eigen::MatrixXd block(n, count);
  for (double& value : block.reshaped()) value = any(engine);
  for (int pass = 0; pass < kPasses; ++pass) {
    for (auto column : block.colwise()) column = project(factor.solve(project(column), 0)).normalized();
    block = orthonormal_basis(block, block.cols());
  }
  const Eigenpairs best = best_in_span(factor, block);
  const Eigen::MatrixXd left = factor.multiply(best.vectors);
  Eigenpairs found{Eigen::VectorXd(0), Eigen::MatrixXd(n, 0), false};
  for (Eigen::Index k = 0; k < count; ++k) {
    if (left.col(k).norm() > kClear) continue;
    found.values.conservativeResize(found.values.size() + 1);
    found.values[found.values.size() - 1] = best.values[k];
    found.vectors.conservativeResize(Eigen::NoChange, found.values.size());
    found.vectors.rightCols(1) = best.vectors.col(k);
  }
  return found;
}

Eigenpairs lowest(const Eigenpairs& pairs, int count) {
  const Eigen::Index n = std::min<Eigen::Index>(count, pairs.values.size());
  return {pairs.values.head(n), pairs.vectors.leftCols(n), pairs.complete};
}

/// Returns all eigenpairs of the small matrix in `factor`, in the space orthogonal to the columns of `left_out`.
Eigenpairs dense_eigenpairs(const SymmetricFactor& factor, const Eigen::SparseMatrix<double>& left_out) {
  const Eigen::Index n = left_out.rows();
  const Eigen::MatrixXd q = orthonormal_basis(Eigen::MatrixXd(left_out), n);
  return best_in_span(factor, q.rightCols(n - left_out.cols()));
}

}  // namespace

Eigenpairs lowest_eigenpairs(SymmetricFactor& factor, const Eigen::SparseMatrix<double>& left_out, int count) {
  const Eigen::Index n = left_out.rows();
  const auto n_null = static_cast<int>(left_out.cols());
  const int available = static_cast<int>(n) - n_null;
  const int wanted = std::min(count, available);
  if (wanted <= 0) return {Eigen::VectorXd(0), Eigen::MatrixXd(n, 0), true};
  if (n <= kDense || 2 * wanted > available) return lowest(dense_eigenpairs(factor, left_out), wanted);

  Projector project(left_out);
  Eigenpairs found{Eigen::VectorXd(0), Eigen::MatrixXd(n, 0), false};
  const int n_negative = factor.count_eigenvalues_below(-kClear);
  const int n_zero = factor.count_eigenvalues_below(kClear) - n_null;
  if (n_negative == 0 && n_zero > 1) {
    make_positive(factor);
    found = search_null_space(factor, project, n, std::min(wanted, n_zero));
    project.take_out(found.vectors);
  }
  int missing = wanted - static_cast<int>(found.values.size());
  found.complete = missing == 0;
  // For every multiple eigenvalue among the lowest eigenvalues, each search finds at least one more eigenvector.
  for (int k = 0; k <= wanted && missing > 0; ++k) {
    const double shift = make_positive(factor);
    const Eigenpairs more = search(factor, project, shift, n, std::min(missing, wanted));
    if (more.values.size() == 0) break;
    Eigen::MatrixXd all(n, found.vectors.cols() + more.vectors.cols());
    all << found.vectors, more.vectors;
    found = best_in_span(factor, all);
    project.take_out(found.vectors);
    const double last = found.values[std::min<Eigen::Index>(wanted, found.values.size()) - 1];
    const double bound = last + std::max(kClear, 1e-9 * std::abs(last));
    const auto n_found = static_cast<int>((found.values.array() < bound).count());
    missing = factor.count_eigenvalues_below(bound) - (bound > 0.0 ? n_null : 0) - n_found;
    missing = std::max(missing, wanted - static_cast<int>(found.values.size()));
    found.complete = missing <= 0;
  }
  return lowest(found, wanted);
}

}  // namespace floc
