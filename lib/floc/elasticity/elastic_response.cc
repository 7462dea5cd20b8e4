#include "floc/elasticity/elastic_response.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "floc/linalg/condensation.h"
#include "floc/linalg/spring_inverse.h"

namespace floc {
namespace {

/// The unknowns that are solved for, made alike: rotations become the displacements they give at the grain's size.
struct ReducedUnknowns {
  std::vector<int> row;      // of each unknown of K; -1: not solved for
  std::vector<int> unknown;  // of K, for each row
  Eigen::VectorXd length;    // of each row: unknown of K = length * value here
};

template <int Dim>
ReducedUnknowns reduce_unknowns(const ContactNetwork<Dim>& network, const std::vector<bool>& kept) {
  ReducedUnknowns r;
  r.row.assign(kept.size(), -1);
  for (int u = 0; u < static_cast<int>(kept.size()); ++u)
    if (kept[u]) r.row[u] = static_cast<int>(r.unknown.size()), r.unknown.push_back(u);
  r.length.resize(static_cast<Eigen::Index>(r.unknown.size()));
  for (int a = 0; a < r.length.size(); ++a) {
    const int u = r.unknown[a];
    r.length[a] = u % kDofs<Dim> < Dim ? 1.0 : 1.0 / network.grain_size[u / kDofs<Dim>];
  }
  return r;
}

template <int Dim>
double largest_stiffness(const ContactNetwork<Dim>& network) {
  double largest = 0.0;
  for (const NetworkContact<Dim>& c : network.contacts) largest = std::max({largest, std::abs(c.kn), c.kt});
  return largest > 0.0 ? largest : 1.0;
}

/// Lower triangle of the block of the grains in those unknowns, over `unit`.
Eigen::SparseMatrix<double> reduce(const Eigen::SparseMatrix<double>& grains, const ReducedUnknowns& r,
                                   double unit) {
  const int n = static_cast<int>(r.unknown.size());
  Eigen::SparseMatrix<double> reduced(n, n);
  if (n == 0) return reduced;  // Eigen cannot compress a matrix without columns
  reduced.reserve(grains.nonZeros());
  for (int b = 0; b < n; ++b) {
    reduced.startVec(b);
    for (Eigen::SparseMatrix<double>::InnerIterator it(grains, r.unknown[b]); it; ++it)
      if (const int a = r.row[it.row()]; a >= 0)
        reduced.insertBack(a, b) = it.value() * (r.length[a] * r.length[b]) / unit;
  }
  reduced.finalize();
  return reduced;
}

/// The springs of a network in those unknowns, over `unit`, with the strains as boundary.
template <int Dim>
class SpringList {
 public:
  SpringList(const ContactNetwork<Dim>& network, const ReducedUnknowns& unknowns, double unit,
             const ResponseOptions& options)
      : unknowns_(unknowns), n_boundary_(n_strains<Dim>(options.strains)) {
    const int n_rows = count(network, options);
    springs_.on_free.resize(n_rows, static_cast<int>(unknowns.unknown.size()));
    springs_.on_free.reserve(n_rows * (Dim + kDofs<Dim>));
    springs_.on_boundary.resize(n_rows, n_boundary_);
    springs_.stiffness.resize(n_rows);
    for (const NetworkContact<Dim>& c : network.contacts) {
      const ContactRows<Dim> rows = contact_rows(c);
      append(c, rows, row_stiffness(c) / unit);
      if (options.prestress) append(c, translation_rows(rows), row_prestress(c) / unit);
    }
    springs_.on_free.finalize();
  }
  SpringSystem take() { return std::move(springs_); }

 private:
  static int count(const ContactNetwork<Dim>& network, const ResponseOptions& options) {
    Eigen::Index n = 0;
    for (const NetworkContact<Dim>& c : network.contacts) {
      n += (row_stiffness(c).array() != 0.0).count();
      if (options.prestress) n += (row_prestress(c).array() != 0.0).count();
    }
    return static_cast<int>(n);
  }

  void append(const NetworkContact<Dim>& c, const ContactRows<Dim>& g, const RowStiffness<Dim>& k) {
    for (int a = 0; a < kDofs<Dim>; ++a) {
      if (k[a] == 0.0) continue;
      springs_.on_free.startVec(n_);
      append_grain(std::min(c.i, c.j), c.i <= c.j ? g.on_i.row(a) : g.on_j.row(a));
      append_grain(std::max(c.i, c.j), c.i <= c.j ? g.on_j.row(a) : g.on_i.row(a));
      springs_.on_boundary.row(n_) = g.on_strain.row(a).head(n_boundary_);
      springs_.stiffness[n_++] = k[a];
    }
  }

  void append_grain(int grain, const auto& values) {
    for (int b = 0; b < kDofs<Dim>; ++b) {
      const int column = unknowns_.row[first_unknown<Dim>(grain) + b];
      if (column >= 0 && values[b] != 0.0)
        springs_.on_free.insertBack(n_, column) = values[b] * unknowns_.length[column];
    }
  }

  const ReducedUnknowns& unknowns_;
  int n_boundary_;
  int n_ = 0;
  SpringSystem springs_;
};

}  // namespace

template <int Dim>
ElasticResponse elastic_response(const ContactNetwork<Dim>& network, const ResponseOptions& options,
                                 SymmetricFactor& factor) {
  ElasticResponse out;
  out.free = find_free_motions(network);
  // Eliminating a dead end takes its contact with it.
  ContactNetwork<Dim> pruned;
  const bool has_ends =
      std::find(out.free.dead_end.begin(), out.free.dead_end.end(), true) != out.free.dead_end.end();
  if (has_ends) pruned = without_grains(network, out.free.dead_end);
  const ContactNetwork<Dim>& core = has_ends ? pruned : network;
  const ReducedUnknowns unknowns = reduce_unknowns(core, out.free.kept);
  const double unit = largest_stiffness(core);
  StiffnessMatrix k = stiffness_matrix(core, {options.strains, options.prestress});
  std::vector<int> grain_of;
  for (const int u : unknowns.unknown) grain_of.push_back(u / kDofs<Dim>);
  factor.set_matrix(reduce(k.grains, unknowns, unit), grain_of);
  k = {};
  std::optional<SpringInverse> inverse = invert_positive(factor);
  const SpringSystem springs = SpringList<Dim>(core, unknowns, unit, options).take();
  if (!inverse) inverse = invert_otherwise(factor, springs, options.mechanism_bound);
  const Condensation condensed = condense(springs, inverse->inverse, {options.tolerance});
  out.n_negative = inverse->n_negative + out.free.n_unstable_ends;
  out.n_mechanisms = inverse->n_mechanisms;
  out.condition = inverse->condition;
  out.resolved = !inverse->inverse.definite || inverse->inverse.smallest_ratio > 0.0;

  out.relaxed = unit * condensed.stiffness;
  out.error = unit * condensed.error;
  const double scale = factor.norm() * condensed.response.lpNorm<Eigen::Infinity>() + condensed.load;
  out.residual = scale > 0.0 ? condensed.imbalance / scale : 0.0;
  out.fluctuation = Eigen::MatrixXd::Zero(network.n_unknowns(), out.relaxed.cols());
  for (int a = 0; a < static_cast<int>(unknowns.unknown.size()); ++a)
    out.fluctuation.row(unknowns.unknown[a]) = condensed.response.row(a) * unknowns.length[a];
  return out;
}

template <int Dim>
ElasticResponse elastic_response(const ContactNetwork<Dim>& network, const ResponseOptions& options) {
  SymmetricFactor factor(options.ordering);
  return elastic_response(network, options, factor);
}

#define FLOC_INSTANTIATE(Dim)                                                                    \
  template ElasticResponse elastic_response(const ContactNetwork<Dim>&, const ResponseOptions&); \
  template ElasticResponse elastic_response(const ContactNetwork<Dim>&, const ResponseOptions&,  \
                                            SymmetricFactor&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
