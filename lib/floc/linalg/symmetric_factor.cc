#include "floc/linalg/symmetric_factor.h"

#include <SuiteSparse_config.h>
#include <cholmod.h>
#include <omp.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

#include "floc/base/huge_pages.h"
#include "floc/linalg/blas.h"
#include "floc/linalg/condition.h"
#include "floc/linalg/signed_factor.h"

namespace floc {
namespace {

/// Value that replaces pivots of L S L^T of smaller absolute value, so that the elimination can continue. The value is
/// far below rounding errors.
constexpr double kSmallestPivot = 1e-30;
/// Limits CHOLMOD to one thread while this object exists. CHOLMOD always starts four threads, even for blocks of a few
/// columns, and no option changes this. The threads mostly wait for each other, so one thread is faster.
class OneThread {
 public:
  OneThread() { omp_set_max_active_levels(0); }
  ~OneThread() { omp_set_max_active_levels(levels_); }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  int levels_ = omp_get_max_active_levels();
};

/// Returns a view of a dense matrix in the form that CHOLMOD requires. The view must not be used to change the matrix.
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
  using Lower = Eigen::Map<const Eigen::SparseMatrix<double, Eigen::ColMajor, SuiteSparse_long>>;

  Ordering ordering;
  std::vector<int> group;  // number of the group to which each unknown belongs
  // permutation from the order of the unknowns for callers of this class to the order in `matrix`
  Eigen::PermutationMatrix<Eigen::Dynamic> to_matrix;
  double norm = 0.0;   // largest absolute row sum of the matrix A
  double shift = 0.0;  // shift s of the last factorization, in which A + s * 1 was factorized
  cholmod_common common{};
  cholmod_sparse* matrix = nullptr;
  // factor by supernodes; its ordering is kept as long as the pattern of A does not change
  cholmod_factor* factor = nullptr;
  bool factorized = false;
  Eigen::VectorXd sign;  // diagonal of S if the last factor is L S L^T; empty if it is L L^T
  FactorCost cost;       // predicted cost of a factorization; valid after analyse()

  explicit Factor(Ordering chosen) : ordering(chosen) {
    prepare_blas();
    SuiteSparse_config.malloc_func = allocate_on_huge_pages;
    cholmod_l_start(&common);
    common.print = 0;
    common.error_handler = nullptr;
    common.useGPU = 0;
    common.nmethods = 1;
    // the unknowns of `matrix` are already in the elimination order
    common.method[0].ordering = CHOLMOD_NATURAL;
    common.postorder = 0;
    common.quick_return_if_not_posdef = 1;
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.final_ll = 1;
  }
  ~Factor() {
    release();
    cholmod_l_finish(&common);
  }
  Factor(const Factor&) = delete;
  Factor& operator=(const Factor&) = delete;

  void release() {
    cholmod_l_free_factor(&factor, &common);
    cholmod_l_free_sparse(&matrix, &common);
    factorized = false;
  }

  void check(const char* doing) const {
    if (common.status < CHOLMOD_OK)
      throw std::runtime_error(std::string("CHOLMOD failed while ") + doing + " (status " +
                               std::to_string(common.status) +
                               (common.status == CHOLMOD_OUT_OF_MEMORY ? ", out of memory)" : ")"));
  }

  SuiteSparse_long size() const { return matrix == nullptr ? 0 : static_cast<SuiteSparse_long>(matrix->ncol); }
  SuiteSparse_long* columns() const { return static_cast<SuiteSparse_long*>(matrix->p); }
  SuiteSparse_long* rows() const { return static_cast<SuiteSparse_long*>(matrix->i); }
  double* values() const { return static_cast<double*>(matrix->x); }
  Lower lower() const { return {size(), size(), columns()[size()], columns(), rows(), values()}; }

  bool has_pattern_of(const cholmod_sparse* other) const {
    if (matrix == nullptr || matrix->ncol != other->ncol) return false;
    const auto* p = static_cast<const SuiteSparse_long*>(other->p);
    const auto* i = static_cast<const SuiteSparse_long*>(other->i);
    return std::equal(p, p + other->ncol + 1, columns()) && std::equal(i, i + p[other->ncol], rows());
  }

  /// Sets the matrix A and puts its unknowns into the elimination order. The symbolic factor is kept if the pattern of
  /// A has not changed.
  void take_matrix(const Eigen::SparseMatrix<double>& lower, std::vector<int> next_group) {
    factorized = false;
    if (group == next_group && matrix != nullptr) {
      cholmod_sparse* next = reordered(lower);
      if (has_pattern_of(next)) {
        cholmod_l_free_sparse(&matrix, &common);
        matrix = next;
        norm = largest_row_sum();
        return;
      }
      cholmod_l_free_sparse(&next, &common);
    }
    release();
    group = std::move(next_group);
    to_matrix.indices() = elimination_places(lower, group, ordering);
    matrix = reordered(lower);
    norm = largest_row_sum();
  }

  double largest_row_sum() const {
    const SuiteSparse_long n = size();
    Eigen::VectorXd row_sums = Eigen::VectorXd::Zero(n);
    for (SuiteSparse_long c = 0; c < n; ++c)
      for (SuiteSparse_long k = columns()[c]; k < columns()[c + 1]; ++k) {
        row_sums[rows()[k]] += std::abs(values()[k]);
        if (rows()[k] != c) row_sums[c] += std::abs(values()[k]);
      }
    return n == 0 ? 0.0 : row_sums.maxCoeff();
  }

  /// Returns the lower triangle of A with its unknowns in the elimination order. The diagonal entry comes first in each
  /// column.
  cholmod_sparse* reordered(const Eigen::SparseMatrix<double>& lower) {
    using Entry = Eigen::SparseMatrix<double>::InnerIterator;
    const int* place = to_matrix.indices().data();
    const auto n = static_cast<int>(lower.cols());
    // At first, `next` contains the number of entries of each column; after the sums below, it contains the place of
    // the next entry of each column.
    std::vector<SuiteSparse_long> next(n + 1, 0);
    for (int c = 0; c < n; ++c) {
      ++next[place[c] + 1];
      for (Entry it(lower, c); it; ++it)
        if (it.row() > c) ++next[std::min(place[c], place[it.row()]) + 1];
    }
    std::partial_sum(next.begin(), next.end(), next.begin());
    cholmod_sparse* out = cholmod_l_allocate_sparse(n, n, next[n], 0, 1, -1, CHOLMOD_REAL, &common);
    check("copying a matrix");
    auto* start = static_cast<SuiteSparse_long*>(out->p);
    std::copy(next.begin(), next.end(), start);
    auto* row = static_cast<SuiteSparse_long*>(out->i);
    auto* value = static_cast<double*>(out->x);
    for (int c = 0; c < n; ++c) {
      const SuiteSparse_long diagonal = next[place[c]]++;
      row[diagonal] = place[c];
      value[diagonal] = 0.0;
    }
    for (int c = 0; c < n; ++c)
      for (Entry it(lower, c); it; ++it) {
        if (it.row() < c) continue;
        if (it.row() == c) {
          value[start[place[c]]] = it.value();
          continue;
        }
        const auto [column, below] = std::minmax(place[c], place[it.row()]);
        row[next[column]] = below;
        value[next[column]++] = it.value();
      }
    return out;
  }

  /// Computes the symbolic factor, unless it already exists.
  void analyse() {
    if (factor != nullptr) return;
    factor = cholmod_l_analyze(matrix, &common);
    check("analysing a matrix");
    cost = {static_cast<double>(factor->xsize) * sizeof(double), common.fl};
  }

  bool factorize_positive(double with_shift) {
    const OneThread one_thread;
    factorized = false;
    if (size() == 0) return true;
    analyse();
    double beta[2] = {with_shift, 0.0};
    cholmod_l_factorize_p(matrix, beta, nullptr, 0, factor, &common);
    check("factorizing a matrix");
    shift = with_shift;
    sign.resize(0);
    factorized = factor->minor == factor->n;
    return factorized;
  }

  bool factorize_signed(double with_shift) {
    factorized = false;
    if (size() == 0) return true;
    analyse();
    if (factor->xtype == CHOLMOD_PATTERN) cholmod_l_change_factor(CHOLMOD_REAL, 1, 1, 1, 1, factor, &common);
    check("allocating a factor");
    const std::vector<double> signs = floc::factorize_signed({{columns(), matrix->ncol + 1}, rows(), values()},
                                                             with_shift, kSmallestPivot, supernodes());
    factor->minor = factor->n;
    shift = with_shift;
    sign = Eigen::Map<const Eigen::VectorXd>(signs.data(), static_cast<Eigen::Index>(signs.size()));
    factorized = !signs.empty();
    return factorized;
  }

  Supernodes supernodes() const {
    const auto span = [](void* values, std::size_t n) {
      return std::span<const std::int64_t>(static_cast<const SuiteSparse_long*>(values), n);
    };
    const std::size_t n = factor->nsuper + 1;
    return {span(factor->super, n), span(factor->pi, n), span(factor->px, n), span(factor->s, factor->ssize),
            static_cast<double*>(factor->x)};
  }

  Eigen::MatrixXd solve_with(int system, const Eigen::MatrixXd& B) {
    cholmod_dense b = as_cholmod(B);
    cholmod_dense* x = cholmod_l_solve(system, factor, &b, &common);
    check("solving");
    Eigen::MatrixXd X = Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(x->x), B.rows(), B.cols());
    cholmod_l_free_dense(&x, &common);
    return X;
  }

  Eigen::MatrixXd apply_inverse(const Eigen::MatrixXd& B) {
    const OneThread one_thread;
    if (sign.size() == 0) return solve_with(CHOLMOD_A, B);
    return solve_with(CHOLMOD_Lt, sign.asDiagonal() * solve_with(CHOLMOD_L, B));
  }

  /// Improves the solution X of A X = B by iterative refinement. The refinement ends when a step reduces the residual
  /// by less than half.
  void refine(Eigen::MatrixXd& X, const Eigen::MatrixXd& B, int max_steps) {
    Eigen::MatrixXd R = B - multiply(X);
    for (int k = 0; k < max_steps && R.norm() > 0.0; ++k) {
      Eigen::MatrixXd refined = X + apply_inverse(R);
      Eigen::MatrixXd left = B - multiply(refined);
      if (!(left.norm() < R.norm())) break;
      const bool stalls = left.norm() > 0.5 * R.norm();
      X.swap(refined);
      R.swap(left);
      if (stalls) break;
    }
  }

  Eigen::MatrixXd multiply(const Eigen::MatrixXd& X) const {
    return lower().selfadjointView<Eigen::Lower>() * X;
  }

  /// Calls visit(d) for each pivot of the last factorization. The number d is the absolute value of the pivot, which is
  /// the square of a diagonal entry of L.
  template <class Visit>
  void for_each_pivot(Visit visit) const {
    const Supernodes l = supernodes();
    for (std::size_t s = 0; s < factor->nsuper; ++s) {
      const SuiteSparse_long n_columns = l.first_column[s + 1] - l.first_column[s];
      const SuiteSparse_long n_rows = l.first_row[s + 1] - l.first_row[s];
      for (SuiteSparse_long k = 0; k < n_columns; ++k) {
        const double diagonal = l.value[l.first_value[s] + k * (n_rows + 1)];
        visit(diagonal * diagonal);
      }
    }
  }
};

SymmetricFactor::SymmetricFactor(Ordering ordering) : factor_(std::make_unique<Factor>(ordering)) {}
SymmetricFactor::~SymmetricFactor() = default;
SymmetricFactor::SymmetricFactor(SymmetricFactor&&) noexcept = default;
SymmetricFactor& SymmetricFactor::operator=(SymmetricFactor&&) noexcept = default;

void SymmetricFactor::set_matrix(const Eigen::SparseMatrix<double>& lower, const std::vector<int>& group) {
  assert(lower.rows() == lower.cols());
  assert(group.empty() || static_cast<Eigen::Index>(group.size()) == lower.cols());
  std::vector<int> groups = group;
  if (group.empty()) {
    groups.resize(lower.cols());
    std::iota(groups.begin(), groups.end(), 0);
  }
  factor_->take_matrix(lower, std::move(groups));
}

FactorCost SymmetricFactor::predicted_cost() {
  if (factor_->size() == 0) return {};
  factor_->analyse();
  return factor_->cost;
}

bool SymmetricFactor::factorize_positive(double shift) {
  return factor_->factorize_positive(shift);
}

bool SymmetricFactor::factorize_indefinite(double shift) {
  return factor_->factorize_signed(shift);
}

int SymmetricFactor::count_eigenvalues_below(double bound) {
  if (factor_->size() == 0) return 0;
  if (!factorize_indefinite(-bound))
    throw std::runtime_error(
        "the eigenvalues of a matrix cannot be counted, because it contains values that are not finite");
  return static_cast<int>((factor_->sign.array() < 0.0).count());
}

double SymmetricFactor::norm() const {
  return factor_->norm;
}

Eigen::MatrixXd SymmetricFactor::multiply(const Eigen::MatrixXd& X) const {
  const auto& to_matrix = factor_->to_matrix;
  return to_matrix.transpose() * factor_->multiply(to_matrix * X);
}

Eigen::MatrixXd SymmetricFactor::solve(const Eigen::MatrixXd& load, int max_refinements) const {
  Factor& f = *factor_;
  assert(f.size() == 0 || (f.factorized && load.rows() == f.size()));
  if (load.size() == 0) return load;
  const Eigen::MatrixXd B = f.to_matrix * load;
  Eigen::MatrixXd X = f.apply_inverse(B);
  if (max_refinements > 0) f.refine(X, B, max_refinements);
  return f.to_matrix.transpose() * X;
}

double SymmetricFactor::condition_estimate() const {
  Factor& f = *factor_;
  if (f.size() == 0) return 1.0;
  assert(f.factorized);
  const auto apply = [&f](const Eigen::VectorXd& x) -> Eigen::VectorXd { return f.apply_inverse(x); };
  return inverse_norm_estimate(f.size(), apply) * (f.norm + std::abs(f.shift));
}

double SymmetricFactor::reciprocal_condition() const {
  const Factor& f = *factor_;
  if (f.size() == 0) return 1.0;
  assert(f.factorized);
  double smallest = std::numeric_limits<double>::infinity(), largest = 0.0;
  f.for_each_pivot([&](double pivot) {
    smallest = std::min(smallest, pivot);
    largest = std::max(largest, pivot);
  });
  return smallest / largest;
}

}  // namespace floc
