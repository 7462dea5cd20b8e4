#include "floc/linalg/symmetric_factor.h"

#include <cholmod.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "floc/linalg/blas.h"

namespace floc {
namespace {

/// Replaces an exactly vanishing pivot of L D L^T so that the elimination goes on; far below any rounding.
constexpr double kSmallestPivot = 1e-30;

/// A view of a dense matrix as CHOLMOD takes it; it is never written through.
cholmod_dense as_cholmod(const Eigen::MatrixXd& m) {
  cholmod_dense view{};
  view.nrow = m.rows();
  view.ncol = m.cols();
  view.nzmax = m.size();
  view.d = m.rows();
  view.x = const_cast<double*>(m.data());
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  return view;
}

}  // namespace

struct SymmetricFactor::Factor {
  Eigen::SparseMatrix<double> lower;
  double norm = 0.0;   // of A, largest absolute row sum
  double shift = 0.0;  // of the last factor
  cholmod_common common{};
  cholmod_sparse* matrix = nullptr;
  cholmod_factor* positive = nullptr;    // supernodal L L^T; its ordering is kept
  cholmod_factor* indefinite = nullptr;  // simplicial L D L^T
  cholmod_factor* current = nullptr;     // whichever of the two was made last

  explicit Factor(Ordering ordering) {
    use_one_blas_thread();
    cholmod_l_start(&common);
    common.print = 0;
    common.error_handler = nullptr;
    common.useGPU = 0;
    common.nmethods = 1;
    common.method[0].ordering = ordering == Ordering::amd ? CHOLMOD_AMD : CHOLMOD_METIS;
    common.quick_return_if_not_posdef = 1;
  }
  ~Factor() {
    release();
    cholmod_l_finish(&common);
  }
  Factor(const Factor&) = delete;
  Factor& operator=(const Factor&) = delete;

  void release() {
    cholmod_l_free_factor(&positive, &common);
    cholmod_l_free_factor(&indefinite, &common);
    cholmod_l_free_sparse(&matrix, &common);
    current = nullptr;
  }

  void check(const char* doing) const {
    if (common.status < CHOLMOD_OK)
      throw std::runtime_error(std::string("CHOLMOD failed while ") + doing + " (status " +
                               std::to_string(common.status) +
                               (common.status == CHOLMOD_OUT_OF_MEMORY ? ", out of memory)" : ")"));
  }

  void copy_matrix() {
    matrix = cholmod_l_allocate_sparse(lower.rows(), lower.cols(), lower.nonZeros(), 1, 1, -1, CHOLMOD_REAL,
                                       &common);
    check("copying a matrix");
    std::copy_n(lower.outerIndexPtr(), lower.cols() + 1, static_cast<SuiteSparse_long*>(matrix->p));
    std::copy_n(lower.innerIndexPtr(), lower.nonZeros(), static_cast<SuiteSparse_long*>(matrix->i));
    std::copy_n(lower.valuePtr(), lower.nonZeros(), static_cast<double*>(matrix->x));
  }

  bool factorize(cholmod_factor*& factor, double with_shift, bool ll) {
    current = nullptr;
    common.supernodal = ll ? CHOLMOD_SUPERNODAL : CHOLMOD_SIMPLICIAL;
    common.final_ll = ll ? 1 : 0;
    common.dbound = ll ? 0.0 : kSmallestPivot;
    if (factor == nullptr) {
      factor = cholmod_l_analyze(matrix, &common);
      check("ordering a matrix");
    }
    double beta[2] = {with_shift, 0.0};
    cholmod_l_factorize_p(matrix, beta, nullptr, 0, factor, &common);
    check("factorizing a matrix");
    shift = with_shift;
    if (factor->minor < factor->n) return false;
    current = factor;
    return true;
  }

  Eigen::MatrixXd apply_inverse(const Eigen::MatrixXd& B) {
    cholmod_dense b = as_cholmod(B);
    cholmod_dense* x = cholmod_l_solve(CHOLMOD_A, current, &b, &common);
    check("solving");
    Eigen::MatrixXd X = Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(x->x), B.rows(), B.cols());
    cholmod_l_free_dense(&x, &common);
    return X;
  }

  Eigen::MatrixXd multiply(const Eigen::MatrixXd& X) const { return lower.selfadjointView<Eigen::Lower>() * X; }

  /// Calls visit(pivot) for every entry of D, or squared diagonal entry of L.
  template <class Visit>
  void for_each_pivot(Visit visit) const {
    const auto* x = static_cast<const double*>(current->x);
    if (!current->is_super) {
      const auto* p = static_cast<const SuiteSparse_long*>(current->p);
      for (std::size_t k = 0; k < current->n; ++k) visit(current->is_ll ? x[p[k]] * x[p[k]] : x[p[k]]);
      return;
    }
    const auto* super = static_cast<const SuiteSparse_long*>(current->super);
    const auto* pi = static_cast<const SuiteSparse_long*>(current->pi);
    const auto* px = static_cast<const SuiteSparse_long*>(current->px);
    for (std::size_t s = 0; s < current->nsuper; ++s) {
      const SuiteSparse_long columns = super[s + 1] - super[s];
      const SuiteSparse_long rows = pi[s + 1] - pi[s];
      for (SuiteSparse_long k = 0; k < columns; ++k) {
        const double diagonal = x[px[s] + k * (rows + 1)];
        visit(diagonal * diagonal);
      }
    }
  }
};

SymmetricFactor::SymmetricFactor(Ordering ordering) : factor_(std::make_unique<Factor>(ordering)) {}
SymmetricFactor::~SymmetricFactor() = default;
SymmetricFactor::SymmetricFactor(SymmetricFactor&&) noexcept = default;
SymmetricFactor& SymmetricFactor::operator=(SymmetricFactor&&) noexcept = default;

void SymmetricFactor::set_matrix(const Eigen::SparseMatrix<double>& lower) {
  assert(lower.rows() == lower.cols());
  Factor& f = *factor_;
  f.release();
  f.lower = lower.triangularView<Eigen::Lower>();
  f.lower.makeCompressed();
  Eigen::VectorXd row_sums = Eigen::VectorXd::Zero(lower.rows());
  for (int c = 0; c < f.lower.outerSize(); ++c)
    for (Eigen::SparseMatrix<double>::InnerIterator it(f.lower, c); it; ++it) {
      row_sums[it.row()] += std::abs(it.value());
      if (it.row() != c) row_sums[c] += std::abs(it.value());
    }
  f.norm = row_sums.size() == 0 ? 0.0 : row_sums.maxCoeff();
  f.copy_matrix();
}

bool SymmetricFactor::factorize_positive(double shift) {
  return factor_->factorize(factor_->positive, shift, true);
}

bool SymmetricFactor::factorize_indefinite(double shift) {
  return factor_->factorize(factor_->indefinite, shift, false);
}

int SymmetricFactor::count_eigenvalues_below(double bound) {
  if (factor_->lower.cols() == 0) return 0;
  if (!factorize_indefinite(-bound))
    throw std::runtime_error("CHOLMOD found a vanishing pivot while counting eigenvalues");
  int n_negative = 0;
  factor_->for_each_pivot([&](double pivot) { n_negative += pivot < 0.0 ? 1 : 0; });
  return n_negative;
}

Eigen::MatrixXd SymmetricFactor::multiply(const Eigen::MatrixXd& X) const {
  return factor_->multiply(X);
}

Eigen::MatrixXd SymmetricFactor::solve(const Eigen::MatrixXd& B, int max_refinements) const {
  Factor& f = *factor_;
  assert(f.lower.cols() == 0 || (f.current != nullptr && B.rows() == f.lower.rows()));
  if (B.size() == 0) return B;
  Eigen::MatrixXd X = f.apply_inverse(B);
  Eigen::MatrixXd R = B - f.multiply(X);
  for (int k = 0; k < max_refinements && R.norm() > 0.0; ++k) {
    Eigen::MatrixXd refined = X + f.apply_inverse(R);
    Eigen::MatrixXd left = B - f.multiply(refined);
    if (!(left.norm() < R.norm())) break;
    const bool stalls = left.norm() > 0.5 * R.norm();
    X.swap(refined);
    R.swap(left);
    if (stalls) break;
  }
  return X;
}

double SymmetricFactor::pivot_ratio() const {
  if (factor_->current == nullptr) return 0.0;
  double smallest = std::numeric_limits<double>::infinity();
  double largest = 0.0;
  factor_->for_each_pivot([&](double pivot) {
    smallest = std::min(smallest, std::abs(pivot));
    largest = std::max(largest, std::abs(pivot));
  });
  return largest > 0.0 ? smallest / largest : 0.0;
}

double SymmetricFactor::condition_estimate() const {
  Factor& f = *factor_;
  const Eigen::Index n = f.lower.cols();
  if (n == 0) return 1.0;
  assert(f.current != nullptr);
  constexpr int kMostSteps = 5;  // Higham: more than that never pays
  Eigen::MatrixXd x = Eigen::MatrixXd::Constant(n, 1, 1.0 / static_cast<double>(n));
  double inverse_norm = 0.0;
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::MatrixXd y = f.apply_inverse(x);
    const double estimate = y.lpNorm<1>();
    if (!(estimate > inverse_norm)) break;
    inverse_norm = estimate;
    const Eigen::MatrixXd signs = y.unaryExpr([](double v) { return v < 0.0 ? -1.0 : 1.0; });
    const Eigen::MatrixXd z = f.apply_inverse(signs);
    Eigen::Index at = 0;
    if (!(z.cwiseAbs().col(0).maxCoeff(&at) > std::abs(z.cwiseProduct(x).sum()))) break;
    x = Eigen::MatrixXd::Zero(n, 1);
    x(at, 0) = 1.0;
  }
  return inverse_norm * (f.norm + std::abs(f.shift));
}

double SymmetricFactor::backward_error(const Eigen::MatrixXd& X, const Eigen::MatrixXd& B) const {
  if (B.size() == 0) return 0.0;
  const Eigen::MatrixXd R = factor_->multiply(X) - B;
  double worst = 0.0;
  for (Eigen::Index c = 0; c < B.cols(); ++c) {
    const double scale =
        factor_->norm * X.col(c).lpNorm<Eigen::Infinity>() + B.col(c).lpNorm<Eigen::Infinity>();
    if (scale > 0.0) worst = std::max(worst, R.col(c).lpNorm<Eigen::Infinity>() / scale);
  }
  return worst;
}

}  // namespace floc
