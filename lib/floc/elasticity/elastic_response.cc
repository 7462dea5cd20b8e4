#include "floc/elasticity/elastic_response.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "floc/elasticity/reduced_unknowns.h"
#include "floc/elasticity/wall_shifts.h"
#include "floc/linalg/condensation.h"
#include "floc/linalg/single_factor.h"
#include "floc/linalg/spring_inverse.h"
#include "floc/network/geometric_springs.h"

namespace floc {
namespace {

/// Lists the springs of a network, with stiffnesses divided by `unit` (force/length). The free unknowns are those
/// motions of the grains that are solved for. The boundary unknowns are the strains of the cell and, between walls, the
/// wall shifts. A wall shift is a common displacement of the two walls of an axis.
template <int Dim>
class SpringList {
 public:
  SpringList(const ContactNetwork<Dim>& network, const ReducedUnknowns& unknowns, double unit,
             const ResponseOptions& options)
      : network_(network), unknowns_(unknowns), strains_(options.strains) {
    const int n_rows = count(network, options);
    springs_.on_free.resize(n_rows, static_cast<int>(unknowns.unknown.size()));
    springs_.on_free.reserve(n_rows * (Dim + kDofs<Dim>));
    springs_.on_boundary.resize(n_rows, n_boundary_unknowns(network, strains_));
    springs_.stiffness.resize(n_rows);
    for (const NetworkContact<Dim>& c : network.contacts) {
      const ContactRows<Dim> rows = contact_rows(c);
      append(c, rows, row_stiffness(c) / unit);
      if (options.prestress)
        for_each_geometric_term(network, c, rows,
                                [&](const auto& moved, const auto& k) { append(c, moved, k / unit); });
    }
    springs_.on_free.finalize();
  }
  SpringSystem take() { return std::move(springs_); }

 private:
  static int count(const ContactNetwork<Dim>& network, const ResponseOptions& options) {
    Eigen::Index n = 0;
    for (const NetworkContact<Dim>& c : network.contacts) {
      n += (row_stiffness(c).array() != 0.0).count();
      if (options.prestress) n += n_geometric_terms(network, c);
    }
    return static_cast<int>(n);
  }

  void append(const NetworkContact<Dim>& c, const ContactRows<Dim>& g, const RowStiffness<Dim>& k) {
    const BoundaryRows<Dim> on_boundary = boundary_rows(network_, g, strains_);
    for (int a = 0; a < kDofs<Dim>; ++a) {
      if (k[a] == 0.0) continue;
      springs_.on_free.startVec(n_);
      append_grain(std::min(c.i, c.j), c.i <= c.j ? g.on_i.row(a) : g.on_j.row(a));
      append_grain(std::max(c.i, c.j), c.i <= c.j ? g.on_j.row(a) : g.on_i.row(a));
      springs_.on_boundary.row(n_) = on_boundary.row(a);
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

  const ContactNetwork<Dim>& network_;
  const ReducedUnknowns& unknowns_;
  StrainSet strains_;
  int n_ = 0;
  SpringSystem springs_;
};

/// Elastic problem of a contact network: the network without dead ends (grains that hang on a single contact), the
/// unknowns that are solved for, and the elastic response.
template <int Dim>
struct Problem {
  const ContactNetwork<Dim>& whole;
  const ResponseOptions& options;
  ElasticResponse answer;
  ContactNetwork<Dim> pruned;  // the network without its dead ends, if it has any
  ReducedUnknowns unknowns;
  double unit = 1.0;
  bool positive = false;  // whether the stiffness matrix has a reliable Cholesky factor

  Problem(const ContactNetwork<Dim>& network, const ResponseOptions& chosen) : whole(network), options(chosen) {
    const FreeMotions& free = answer.free = find_free_motions(network);
    // Dead ends and their single contacts carry no load and are removed.
    if (has_ends()) pruned = without_grains(network, free.dead_end);
    unknowns = reduce_unknowns(core(), free.kept);
    unit = stiffness_scale(core());
  }
  Problem(const Problem&) = delete;
  Problem& operator=(const Problem&) = delete;

  bool has_ends() const {
    return std::find(answer.free.dead_end.begin(), answer.free.dead_end.end(), true) !=
           answer.free.dead_end.end();
  }
  const ContactNetwork<Dim>& core() const { return has_ends() ? pruned : whole; }
  Eigen::SparseMatrix<double> stiffness() const {
    return reduce(stiffness_matrix(core(), {options.strains, options.prestress}).grains, unknowns, unit);
  }
  SpringSystem springs() const { return SpringList<Dim>(core(), unknowns, unit, options).take(); }

  /// Returns a result that contains no response, but the reason: the factor would take too many bytes.
  ElasticResponse refuse(double bytes) {
    answer.factor_bytes = bytes;
    answer.failure = fmt::format(
        "the factor of the stiffness matrix of {} unknowns would take {:.1f} GB, but at most {:.1f} GB are "
        "allowed",
        unknowns.unknown.size(), bytes / 1e9, options.largest_factor / 1e9);
    return std::move(answer);
  }

  /// Converts the condensed springs into the elastic response, in the unknowns of the whole network.
  /// @param norm  norm of the stiffness matrix, or a lower bound on this norm
  ElasticResponse take(const Condensation& condensed, double norm) {
    ElasticResponse& out = answer;
    out.n_negative += out.free.n_unstable_ends;
    out.steps = condensed.steps;
    out.relaxed = unit * condensed.stiffness;
    out.error = unit * condensed.error;
    const double scale = norm * condensed.response.template lpNorm<Eigen::Infinity>() + condensed.load;
    out.residual = scale > 0.0 ? condensed.imbalance / scale : 0.0;
    out.fluctuation = Eigen::MatrixXd::Zero(whole.n_unknowns(), out.relaxed.cols());
    for (int a = 0; a < static_cast<int>(unknowns.unknown.size()); ++a)
      out.fluctuation.row(unknowns.unknown[a]) = condensed.response.row(a) * unknowns.length[a];
    relax_wall_shifts(whole, out);
    return std::move(out);
  }
};

template <int Dim>
ElasticResponse solve_by_factor(Problem<Dim>& problem, SymmetricFactor& factor) {
  factor.set_matrix(problem.stiffness(), grain_of_rows<Dim>(problem.unknowns));
  if (const double bytes = factor.predicted_cost().bytes; bytes > problem.options.largest_factor)
    return problem.refuse(bytes);
  std::optional<SpringInverse> inverse = invert_positive(factor);
  problem.positive = inverse.has_value();
  const SpringSystem springs = problem.springs();
  if (!inverse)
    inverse =
        invert_singular(factor, springs, problem.options.mechanism_bound, problem.options.mechanism_length);
  ElasticResponse& out = problem.answer;
  out.n_negative = inverse->n_negative;
  out.n_mechanisms = inverse->n_mechanisms;
  out.condition = inverse->condition;
  out.resolved = !inverse->inverse.definite || inverse->inverse.smallest_ratio > 0.0;
  return problem.take(condense(springs, inverse->inverse, {.tolerance = problem.options.tolerance}),
                      factor.norm());
}

/// Returns the diagonal of the stiffness matrix: the stiffness of each unknown while all others are fixed.
Eigen::VectorXd diagonal_of(const SpringSystem& springs) {
  Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(springs.on_free.cols());
  for (Eigen::Index r = 0; r < springs.on_free.rows(); ++r)
    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(springs.on_free, r); it; ++it)
      diagonal[it.col()] += springs.stiffness[r] * it.value() * it.value();
  return diagonal;
}

/// Largest number of iteration steps with a factor that was made for another network. If more steps are needed, a new
/// factor is cheaper. For 1400 grains, computing a factor takes as long as some 30 steps.
constexpr int kMaxSteps = 40;

/// Solves for the motions of the grains by refinement with an approximate inverse of the stiffness matrix. The accuracy
/// of the inverse need not be known.
/// @param apply  returns the product of the approximate inverse with a vector
/// @param start  motions of the grains from which the refinement starts, one column per strain or wall displacement;
/// may be empty
/// @return no value if the refinement does not converge
template <int Dim>
std::optional<ElasticResponse> solve_by_approximate_inverse(
    Problem<Dim>& problem, const SpringSystem& springs,
    std::function<Eigen::VectorXd(const Eigen::VectorXd&)> apply, const Eigen::MatrixXd& start) {
  /// If the tolerance of the solution is smaller than this number, residual forces are computed in extended precision.
  /// Otherwise double precision suffices.
  constexpr double kDoubleSuffices = 1e-9;
  ApproximateInverse inverse;
  inverse.apply = std::move(apply);
  inverse.estimated_ratio = true;
  const double tolerance = problem.options.tolerance;
  const CondensationOptions options{.tolerance = tolerance,
                                    .max_steps = kMaxSteps,
                                    .extended = tolerance < kDoubleSuffices,
                                    .patience = kMaxSteps,
                                    .start = start};
  const Condensation condensed = condense(springs, inverse, options);
  if (!condensed.converged) return std::nullopt;
  problem.answer.counted = false;
  // an estimate of the condition number would need a complete factorization
  problem.answer.condition = std::numeric_limits<double>::quiet_NaN();
  const double norm = springs.on_free.cols() == 0 ? 0.0 : diagonal_of(springs).maxCoeff();
  return problem.take(condensed, norm);
}

template <int Dim>
std::optional<ElasticResponse> solve_by_single_factor(Problem<Dim>& problem) {
  const SingleFactor factor(problem.stiffness());
  if (!factor.positive()) return std::nullopt;
  return solve_by_approximate_inverse(problem, problem.springs(),
                                      [&](const auto& b) { return factor.solve(b); }, {});
}

/// Approximate inverse of the stiffness matrix of this network, made from the factor of another network. The factor is
/// used for unknowns that both networks have. For all other unknowns, the diagonal entry of the matrix is inverted.
class InheritedInverse {
 public:
  InheritedInverse(const ResponseMemory& memory, const ReducedUnknowns& unknowns, Eigen::VectorXd diagonal)
      : memory_(memory), diagonal_(std::move(diagonal)) {
    row_.assign(memory.unknown.size(), -1);
    scale_.assign(memory.unknown.size(), 0.0);
    for (std::size_t a = 0; a < memory.unknown.size(); ++a) {
      row_[a] = unknowns.row[memory.unknown[a]];
      if (row_[a] < 0) continue;
      scale_[a] = unknowns.length[row_[a]] / memory.length[static_cast<Eigen::Index>(a)];
      diagonal_[row_[a]] = 0.0;
    }
  }

  Eigen::VectorXd operator()(const Eigen::VectorXd& b) const {
    Eigen::VectorXd inherited = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(row_.size()));
    for (std::size_t a = 0; a < row_.size(); ++a)
      if (row_[a] >= 0) inherited[static_cast<Eigen::Index>(a)] = b[row_[a]] / scale_[a];
    const Eigen::VectorXd solved = memory_.factor->solve(inherited, 0);
    Eigen::VectorXd x = (diagonal_.array() > 0.0).select(b.array() / diagonal_.array(), 0.0).matrix();
    for (std::size_t a = 0; a < row_.size(); ++a)
      if (row_[a] >= 0) x[row_[a]] = solved[static_cast<Eigen::Index>(a)] / scale_[a];
    return x;
  }

 private:
  const ResponseMemory& memory_;
  // diagonal entry of the stiffness matrix for each unknown that the factor does not contain; 0 for the other unknowns
  Eigen::VectorXd diagonal_;
  // for each row of the factor, the row of its unknown in this network; -1 if there is none
  std::vector<int> row_;
  // for each row of the factor: the value solved for in the other network (a length, see ReducedUnknowns), divided by
  // the value solved for in this network
  std::vector<double> scale_;
};

template <int Dim>
std::optional<ElasticResponse> solve_from(const ResponseMemory& memory, Problem<Dim>& problem) {
  const ReducedUnknowns& unknowns = problem.unknowns;
  // The stored fluctuation is the initial guess of the solver. It has a column for each strain, but no columns for
  // displacements of walls. Therefore it cannot be used for a packing between walls.
  if (!memory.factor || !problem.whole.wall_axes.empty() ||
      memory.fluctuation.rows() != problem.whole.n_unknowns() ||
      memory.fluctuation.cols() != n_strains<Dim>(problem.options.strains))
    return std::nullopt;
  Eigen::MatrixXd start(unknowns.length.size(), memory.fluctuation.cols());
  for (Eigen::Index a = 0; a < start.rows(); ++a)
    start.row(a) = memory.fluctuation.row(unknowns.unknown[static_cast<std::size_t>(a)]) / unknowns.length[a];
  const SpringSystem springs = problem.springs();
  return solve_by_approximate_inverse(problem, springs,
                                      InheritedInverse(memory, unknowns, diagonal_of(springs)), start);
}

}  // namespace

template <int Dim>
ElasticResponse elastic_response(const ContactNetwork<Dim>& network, const ResponseOptions& options,
                                 SymmetricFactor& factor) {
  Problem<Dim> problem(network, options);
  if (options.solver == ResponseSolver::single_factor)
    if (auto answer = solve_by_single_factor(problem)) return std::move(*answer);
  return solve_by_factor(problem, factor);
}

template <int Dim>
ElasticResponse elastic_response(const ContactNetwork<Dim>& network, const ResponseOptions& options) {
  SymmetricFactor factor(options.ordering);
  return elastic_response(network, options, factor);
}

template <int Dim>
ElasticResponse elastic_response(const ContactNetwork<Dim>& network, const ResponseOptions& options,
                                 ResponseMemory& memory) {
  Problem<Dim> problem(network, options);
  std::optional<ElasticResponse> answer = solve_from(memory, problem);
  if (!answer) {
    memory.factor = std::make_unique<SymmetricFactor>(options.ordering);
    memory.unknown = problem.unknowns.unknown;
    memory.length = problem.unknowns.length;
    answer = solve_by_factor(problem, *memory.factor);
    if (!problem.positive)
      memory.factor.reset();  // the factor of an indefinite matrix cannot be a
                              // preconditioner
  }
  memory.fluctuation = answer->fluctuation;
  return std::move(*answer);
}

#define FLOC_INSTANTIATE(Dim)                                                                    \
  template ElasticResponse elastic_response(const ContactNetwork<Dim>&, const ResponseOptions&); \
  template ElasticResponse elastic_response(const ContactNetwork<Dim>&, const ResponseOptions&,  \
                                            SymmetricFactor&);                                   \
  template ElasticResponse elastic_response(const ContactNetwork<Dim>&, const ResponseOptions&,  \
                                            ResponseMemory&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
