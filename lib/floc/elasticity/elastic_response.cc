#include "floc/elasticity/elastic_response.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace floc {
namespace {

/// Beyond this condition number a mechanism may hide behind a Cholesky factor that rounding let succeed.
constexpr double kSuspiciousCondition = 1e10;
/// Refinements where a small shift stands in for mechanisms: each gains the ratio of shift and eigenvalue.
constexpr int kShiftedRefinements = 20;

/// K without its free motions, in unknowns and forces that make it dimensionless.
struct ReducedStiffness {
  Eigen::SparseMatrix<double> grains;  // lower triangle
  Eigen::MatrixXd border;
  std::vector<int> unknown;  // of K, for each row here
  Eigen::VectorXd scale;     // K = scale * grains * scale
};

template <int Dim>
double largest_stiffness(const ContactNetwork<Dim>& network) {
  double largest = 0.0;
  for (const NetworkContact<Dim>& c : network.contacts) largest = std::max({largest, std::abs(c.kn), c.kt});
  return largest > 0.0 ? largest : 1.0;
}

template <int Dim>
ReducedStiffness reduce(const ContactNetwork<Dim>& network, const StiffnessMatrix& k,
                        const std::vector<bool>& kept) {
  ReducedStiffness r;
  std::vector<int> row_of(kept.size(), -1);
  for (int u = 0; u < static_cast<int>(kept.size()); ++u)
    if (kept[u]) row_of[u] = static_cast<int>(r.unknown.size()), r.unknown.push_back(u);
  const int n = static_cast<int>(r.unknown.size());
  const double unit = std::sqrt(largest_stiffness(network));
  r.scale.resize(n);
  r.border.resize(n, k.border.cols());
  for (int a = 0; a < n; ++a) {
    const int u = r.unknown[a];
    r.scale[a] = u % kDofs<Dim> < Dim ? unit : unit * network.grain_size[u / kDofs<Dim>];
    r.border.row(a) = k.border.row(u) / r.scale[a];
  }
  r.grains.resize(n, n);
  if (n == 0) return r;  // Eigen cannot compress a matrix without columns
  Eigen::VectorXi column_sizes = Eigen::VectorXi::Zero(n);
  for (int b = 0; b < n; ++b)
    for (Eigen::SparseMatrix<double>::InnerIterator it(k.grains, r.unknown[b]); it; ++it)
      column_sizes[b] += row_of[it.row()] >= 0 ? 1 : 0;
  r.grains.reserve(column_sizes);
  for (int b = 0; b < n; ++b)
    for (Eigen::SparseMatrix<double>::InnerIterator it(k.grains, r.unknown[b]); it; ++it)
      if (const int a = row_of[it.row()]; a >= 0)
        r.grains.insert(a, b) = it.value() / (r.scale[a] * r.scale[b]);
  r.grains.makeCompressed();
  return r;
}

/// Whether K could have a negative eigenvalue at all: without prestress it is G^T k G.
template <int Dim>
bool may_be_indefinite(const ContactNetwork<Dim>& network, const ResponseOptions& options) {
  return options.prestress || std::any_of(network.contacts.begin(), network.contacts.end(),
                                          [](const NetworkContact<Dim>& c) { return c.kn < 0.0; });
}

/// Leaves a usable factor and fills in the counts. Returns how many refinements a solve needs.
int factorize(SymmetricFactor& factor, bool may_have_negative, double bound, ElasticResponse& out) {
  constexpr int kRefinements = 3;
  if (factor.factorize_positive()) {
    out.condition = factor.condition_estimate();
    if (out.condition < kSuspiciousCondition) return kRefinements;
  }
  const int below = factor.count_eigenvalues_below(-bound);
  const int n_small = factor.count_eigenvalues_below(bound) - below;
  // Rounding alone does not make G^T k G indefinite by more than the bound.
  out.n_negative = may_have_negative ? below : 0;
  out.n_mechanisms = n_small;
  const double shift = n_small > 0 ? 10.0 * bound : 0.0;
  const bool factorized =
      (out.n_negative == 0 && factor.factorize_positive(shift)) || factor.factorize_indefinite(shift);
  out.condition =
      n_small > 0 || !factorized ? std::numeric_limits<double>::infinity() : factor.condition_estimate();
  return kShiftedRefinements;
}

}  // namespace

template <int Dim>
ElasticResponse elastic_response(const ContactNetwork<Dim>& network, const ResponseOptions& options) {
  ElasticResponse out;
  out.free = find_free_motions(network);
  // Eliminating a dead end takes its contact with it.
  const ContactNetwork<Dim> core = without_grains(network, out.free.dead_end);
  const StiffnessMatrix k = stiffness_matrix(core, {options.strains, options.prestress});
  const ReducedStiffness reduced = reduce(core, k, out.free.kept);
  SymmetricFactor factor(options.ordering);
  factor.set_matrix(reduced.grains);
  const int refinements = factorize(factor, may_be_indefinite(core, options), options.mechanism_bound, out);
  out.n_negative += out.free.n_unstable_ends;

  const Eigen::MatrixXd y = factor.solve(reduced.border, refinements);
  out.residual = factor.backward_error(y, reduced.border);
  // The variational form: an error of the solution enters squared.
  const Eigen::MatrixXd linear = reduced.border.transpose() * y;
  out.relaxed = k.boundary - linear - linear.transpose() + y.transpose() * factor.multiply(y);
  out.relaxed = 0.5 * (out.relaxed + out.relaxed.transpose()).eval();
  out.fluctuation = Eigen::MatrixXd::Zero(network.n_unknowns(), k.border.cols());
  for (int a = 0; a < static_cast<int>(reduced.unknown.size()); ++a)
    out.fluctuation.row(reduced.unknown[a]) = -y.row(a) / reduced.scale[a];
  return out;
}

template ElasticResponse elastic_response(const ContactNetwork<2>&, const ResponseOptions&);
template ElasticResponse elastic_response(const ContactNetwork<3>&, const ResponseOptions&);

}  // namespace floc
