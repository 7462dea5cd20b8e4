#include "floc/linalg/symmetric_factor.h"

#include <cholmod.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include "floc/linalg/blas.h"
#include "floc/linalg/condition.h"

namespace floc {
namespace {

/// Replaces an exactly vanishing pivot of L D L^T so that the elimination goes on; far below any rounding.
constexpr double kSmallestPivot = 1e-30;
/// Operations of a factor, for each group, beyond which nested dissection is looked for: finding it takes as long as
/// some 3e5 operations a group.
constexpr double kNestedDissectionCost = 1e6;

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
  using Lower = Eigen::Map<const Eigen::SparseMatrix<double, Eigen::ColMajor, SuiteSparse_long>>;

  Ordering ordering;
  std::vector<SuiteSparse_long> group;  // of each unknown
  double norm = 0.0;                    // of A, largest absolute row sum
  double shift = 0.0;                   // of the last factor
  cholmod_common common{};
  cholmod_sparse* matrix = nullptr;
  cholmod_factor* positive = nullptr;    // supernodal L L^T; its ordering is kept
  cholmod_factor* indefinite = nullptr;  // simplicial L D L^T
  cholmod_factor* current = nullptr;     // whichever of the two was made last

  explicit Factor(Ordering chosen) : ordering(chosen) {
    prepare_blas();
    cholmod_l_start(&common);
    common.print = 0;
    common.error_handler = nullptr;
    common.useGPU = 0;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
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

  /// Takes A over; symbolic factors stay if they hold for it.
  void take_matrix(cholmod_sparse* next, std::vector<SuiteSparse_long> next_group) {
    if (group != next_group || !has_pattern_of(next)) release();
    cholmod_l_free_sparse(&matrix, &common);
    matrix = next;
    group = std::move(next_group);
    current = nullptr;
    const SuiteSparse_long n = size();
    Eigen::VectorXd row_sums = Eigen::VectorXd::Zero(n);
    for (SuiteSparse_long c = 0; c < n; ++c)
      for (SuiteSparse_long k = columns()[c]; k < columns()[c + 1]; ++k) {
        row_sums[rows()[k]] += std::abs(values()[k]);
        if (rows()[k] != c) row_sums[c] += std::abs(values()[k]);
      }
    norm = n == 0 ? 0.0 : row_sums.maxCoeff();
  }

  /// Pattern of the groups: lower triangle, one entry a pair of groups that share an entry of A.
  cholmod_sparse* group_pattern(SuiteSparse_long n_groups) {
    std::vector<SuiteSparse_long> start{0}, row;
    std::vector<SuiteSparse_long> last_seen(n_groups, -1);
    for (SuiteSparse_long c = 0; c < size(); ++c) {
      const SuiteSparse_long g = group[c];
      while (static_cast<SuiteSparse_long>(start.size()) <= g)
        start.push_back(static_cast<SuiteSparse_long>(row.size()));
      for (SuiteSparse_long k = columns()[c]; k < columns()[c + 1]; ++k) {
        const SuiteSparse_long h = group[rows()[k]];
        if (h == g || last_seen[h] == g) continue;
        last_seen[h] = g;
        row.push_back(h);
      }
    }
    while (static_cast<SuiteSparse_long>(start.size()) <= n_groups)
      start.push_back(static_cast<SuiteSparse_long>(row.size()));
    cholmod_sparse* pattern =
        cholmod_l_allocate_sparse(n_groups, n_groups, row.size(), 0, 1, -1, CHOLMOD_PATTERN, &common);
    check("finding the pattern of a matrix");
    std::copy(start.begin(), start.end(), static_cast<SuiteSparse_long*>(pattern->p));
    std::copy(row.begin(), row.end(), static_cast<SuiteSparse_long*>(pattern->i));
    return pattern;
  }

  /// Fill-reducing order of the unknowns, found on their groups.
  std::vector<SuiteSparse_long> order_unknowns(bool metis) {
    const SuiteSparse_long n_groups = group.back() + 1;
    std::vector<SuiteSparse_long> group_order(n_groups);
    cholmod_sparse* pattern = group_pattern(n_groups);
    if (metis)
      cholmod_l_metis(pattern, nullptr, 0, 1, group_order.data(), &common);
    else
      cholmod_l_amd(pattern, nullptr, 0, group_order.data(), &common);
    cholmod_l_free_sparse(&pattern, &common);
    check("ordering a matrix");
    std::vector<SuiteSparse_long> first(n_groups + 1, 0);
    for (const SuiteSparse_long g : group) ++first[g + 1];
    for (SuiteSparse_long g = 0; g < n_groups; ++g) first[g + 1] += first[g];
    std::vector<SuiteSparse_long> order;
    order.reserve(group.size());
    for (const SuiteSparse_long g : group_order)
      for (SuiteSparse_long k = first[g]; k < first[g + 1]; ++k) order.push_back(k);
    return order;
  }

  /// Symbolic factor. Common.fl is left with the operations that the numeric one will take.
  cholmod_factor* analyse_by(bool metis) {
    cholmod_factor* symbolic = cholmod_l_analyze_p(matrix, order_unknowns(metis).data(), nullptr, 0, &common);
    check("analysing a matrix");
    return symbolic;
  }

  cholmod_factor* analyse() {
    cholmod_factor* symbolic = analyse_by(ordering == Ordering::metis);
    const double operations = common.fl;
    if (ordering != Ordering::automatic ||
        operations < kNestedDissectionCost * static_cast<double>(group.back() + 1))
      return symbolic;
    cholmod_factor* dissected = analyse_by(true);
    if (common.fl < operations) std::swap(symbolic, dissected);
    cholmod_l_free_factor(&dissected, &common);
    return symbolic;
  }

  bool factorize(cholmod_factor*& factor, double with_shift, bool ll) {
    current = nullptr;
    if (size() == 0) return true;
    common.supernodal = ll ? CHOLMOD_SUPERNODAL : CHOLMOD_SIMPLICIAL;
    common.final_ll = ll ? 1 : 0;
    common.dbound = ll ? 0.0 : kSmallestPivot;
    if (factor == nullptr) {
      factor = analyse();
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

  Eigen::MatrixXd multiply(const Eigen::MatrixXd& X) const {
    return lower().selfadjointView<Eigen::Lower>() * X;
  }

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

void SymmetricFactor::set_matrix(const Eigen::SparseMatrix<double>& lower, const std::vector<int>& group) {
  assert(lower.rows() == lower.cols());
  assert(group.empty() || static_cast<Eigen::Index>(group.size()) == lower.cols());
  Factor& f = *factor_;
  cholmod_sparse* copy = cholmod_l_allocate_sparse(lower.rows(), lower.cols(), lower.nonZeros(), 1, 1, -1,
                                                   CHOLMOD_REAL, &f.common);
  f.check("copying a matrix");
  auto* start = static_cast<SuiteSparse_long*>(copy->p);
  auto* rows = static_cast<SuiteSparse_long*>(copy->i);
  auto* values = static_cast<double*>(copy->x);
  SuiteSparse_long at = 0;
  for (int c = 0; c < lower.outerSize(); ++c) {
    start[c] = at;
    for (Eigen::SparseMatrix<double>::InnerIterator it(lower, c); it; ++it)
      if (it.row() >= c) rows[at] = it.row(), values[at++] = it.value();
  }
  start[lower.cols()] = at;
  std::vector<SuiteSparse_long> groups(group.begin(), group.end());
  if (group.empty()) {
    groups.resize(lower.cols());
    std::iota(groups.begin(), groups.end(), 0);
  }
  f.take_matrix(copy, std::move(groups));
}

bool SymmetricFactor::factorize_positive(double shift) {
  return factor_->factorize(factor_->positive, shift, true);
}

bool SymmetricFactor::factorize_indefinite(double shift) {
  return factor_->factorize(factor_->indefinite, shift, false);
}

int SymmetricFactor::count_eigenvalues_below(double bound) {
  if (factor_->size() == 0) return 0;
  if (!factorize_indefinite(-bound))
    throw std::runtime_error("CHOLMOD found a vanishing pivot while counting eigenvalues");
  int n_negative = 0;
  factor_->for_each_pivot([&](double pivot) { n_negative += pivot < 0.0 ? 1 : 0; });
  return n_negative;
}

double SymmetricFactor::norm() const {
  return factor_->norm;
}

Eigen::MatrixXd SymmetricFactor::multiply(const Eigen::MatrixXd& X) const {
  return factor_->multiply(X);
}

Eigen::MatrixXd SymmetricFactor::solve(const Eigen::MatrixXd& B, int max_refinements) const {
  Factor& f = *factor_;
  assert(f.size() == 0 || (f.current != nullptr && B.rows() == f.size()));
  if (B.size() == 0) return B;
  Eigen::MatrixXd X = f.apply_inverse(B);
  if (max_refinements == 0) return X;
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

double SymmetricFactor::condition_estimate() const {
  Factor& f = *factor_;
  if (f.size() == 0) return 1.0;
  assert(f.current != nullptr);
  const auto apply = [&f](const Eigen::VectorXd& x) -> Eigen::VectorXd { return f.apply_inverse(x); };
  return inverse_norm_estimate(f.size(), apply) * (f.norm + std::abs(f.shift));
}

}  // namespace floc
