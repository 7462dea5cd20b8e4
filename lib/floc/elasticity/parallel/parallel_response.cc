#include "floc/elasticity/parallel/parallel_response.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "floc/base/infinity.h"
#include "floc/elasticity/parallel/local_rows.h"
#include "floc/elasticity/wall_shifts.h"

namespace floc {
namespace {

/// The first solution has to reduce the residual forces to the share kFirstReduction of their initial size. The
/// remaining energy is then reduced to about the square of this share. A later solution never has to reduce the
/// residual forces to a share below kLeastReduction, because rounding prevents a further reduction.
constexpr double kFirstReduction = 1e-6;
constexpr double kLeastReduction = 1e-8;
/// The grains are relaxed in rounds: each round solves for the residual forces that the previous round has left. There
/// are at most kMostRounds rounds. A new round begins only if the last round has reduced the remaining energy to less
/// than kGain times its value before the last round.
constexpr int kMostRounds = 6;
constexpr double kGain = 0.25;
/// The smallest Ritz value times this factor is taken as a lower bound on the eigenvalues of the preconditioned
/// stiffness matrix.
constexpr double kShareOfRitz = 0.1;
/// Two limits for a stiffness after relaxation of the grains, as shares of the stiffness without relaxation: kRounding
/// is the rounding error of the stiffness, and a stiffness up to kNothing cannot be distinguished from zero.
constexpr double kRounding = 1e-14;
constexpr double kNothing = 1e-11;
/// Largest accepted relative error of a stiffness after relaxation of the grains; if the error is larger, the solution
/// counts as failed.
constexpr double kUseful = 1e-6;

/// Returns, for each grain, whether it has a contact.
template <int Dim>
std::vector<bool> in_contact(const ContactNetwork<Dim>& network) {
  std::vector<bool> taken(network.n_grains, false);
  for (const NetworkContact<Dim>& c : network.contacts) taken[c.i] = taken[c.j] = true;
  return taken;
}

/// Static condensation of the stiffness matrix: displaces each boundary unknown (a strain of the cell or a wall
/// displacement) in turn by 1 and relaxes the grains.
template <int Dim>
class ParallelCondensation {
 public:
  ParallelCondensation(const LocalRows<Dim>& rows, double norm, double tolerance, ParallelSolver& solver)
      : rows_(rows), norm_(norm), tolerance_(tolerance), solver_(solver) {}

  /// Displaces each boundary unknown in turn, relaxes the grains, and computes `stiffness` and `error`.
  /// @return reason why the relaxation failed, as a sentence; empty if all solutions converged
  std::string relax(int n_boundary) {
    for (int b = 0; b < n_boundary; ++b)
      if (std::string failure = relax_one(b); !failure.empty()) return failure;
    const Eigen::MatrixXd energies = stiffness_and_rounding();
    stiffness = energies.leftCols(n_boundary);
    error = energies.rightCols(n_boundary);
    const Eigen::Map<const Eigen::VectorXd> root(excess_root_.data(), n_boundary);
    error += root * root.transpose() + std::numeric_limits<double>::epsilon() * stiffness.cwiseAbs();
    return {};
  }

  Eigen::MatrixXd stiffness, error;
  double residual = 0.0;  // largest relative backward error of the solutions
  int steps = 0;

 private:
  using Balance = typename LocalRows<Dim>::Balance;

  /// Displaces boundary unknown b by 1 and relaxes the grains. The remaining net forces are solved for repeatedly,
  /// until the energy that further relaxation would release is within the tolerance.
  /// @return reason for a failure, as a sentence, or empty
  std::string relax_one(int b) {
    Eigen::VectorXd u = Eigen::VectorXd::Zero(rows_.n_at_hand());
    Balance now = balance(u, b);
    const double load = largest(now.net), affine = now.energy;
    double excess = load > 0.0 ? kInfinity : 0.0, reduction = kFirstReduction;
    int n_steps = 0;
    for (int round = 0; excess > wanted(now, affine) && round < kMostRounds; ++round) {
      Eigen::VectorXd next = u;
      const ParallelSolution solution = solver_.solve(as_span(now.net), own_part(next), reduction);
      n_steps += solution.iterations;
      if (!solution.converged) return solution.failure;
      if (solution.iterations > 0) ratio_ = std::min(ratio_, kShareOfRitz * solution.smallest_ratio);
      next.head(rows_.n_own()) += u.head(rows_.n_own());
      fetch(next);
      Balance after = balance(next, b);
      // Twice the energy that further relaxation would release is r^T K^-1 r, with the net forces r and the stiffness
      // matrix K. The inverse of K is not available. With the preconditioner M and an estimated lower bound `ratio_` on
      // the eigenvalues of M^-1 K, r^T K^-1 r is at most r^T M^-1 r divided by `ratio_`.
      const double left = std::abs(solver_.preconditioned_square(as_span(after.net))) / ratio_;
      const bool gains = left < kGain * excess;
      if (left < excess) excess = left, u.swap(next), std::swap(now, after);
      if (!gains) break;
      // The energy is quadratic in the net forces. The share to which the forces have to fall is therefore the square
      // root of the ratio of the tolerance to `excess`. The factor 0.3 is a margin, so that the next round is the last
      // one if rounding permits it.
      reduction = std::clamp(0.3 * std::sqrt(wanted(now, affine) / excess), kLeastReduction, 0.1);
    }
    // The rounds may have ended at the limit of rounding, with an error above the tolerance. Such a stiffness is
    // accepted if its relative error is at most kUseful. It is also accepted if the error is so small that, up to this
    // error, the stiffness cannot be distinguished from zero (kNothing). The negated comparison also rejects NaN.
    if (!(excess <= std::max(kUseful * std::abs(now.energy), kNothing * affine)))
      return fmt::format(
          "rounding causes an error of {:.1e} in the stiffness {:.1e} of the relaxed network (stiffness before "
          "relaxation: {:.1e})",
          excess, now.energy, affine);
    steps = std::max(steps, n_steps);
    const double scale = norm_ * largest(u) + load;
    if (scale > 0.0) residual = std::max(residual, largest(now.net) / scale);
    excess_root_.push_back(std::sqrt(excess));
    u_.push_back(std::move(u));
    return {};
  }

  /// Returns the tolerance on twice the energy that further relaxation would release.
  /// @param now     balance of the grains after the relaxation so far
  /// @param affine  twice the energy before relaxation
  double wanted(const Balance& now, double affine) const {
    return std::max(tolerance_ * std::abs(now.energy), kRounding * affine);
  }

  Balance balance(const Eigen::VectorXd& u, int b) {
    Balance now = rows_.balance(u, b);
    solver_.sum({&now.energy, 1});
    return now;
  }

  static std::span<const double> as_span(const Eigen::VectorXd& v) {
    return {v.data(), static_cast<std::size_t>(v.size())};
  }

  std::span<double> own_part(Eigen::VectorXd& u) const {
    return {u.data(), static_cast<std::size_t>(rows_.n_own())};
  }

  /// Fetches, from other processes, the motions of their grains that touch grains of this process.
  void fetch(Eigen::VectorXd& u) {
    const auto n = static_cast<std::size_t>(rows_.n_own());
    solver_.exchange(own_part(u), {u.data() + n, static_cast<std::size_t>(u.size()) - n});
  }

  double largest(const Eigen::VectorXd& v) {
    double value = v.size() == 0 ? 0.0 : v.lpNorm<Eigen::Infinity>();
    solver_.maximum({&value, 1});
    return value;
  }

  Eigen::MatrixXd stiffness_and_rounding() {
    const auto own = rows_.energies(u_);
    Eigen::MatrixXd both(own.stiffness.rows(), 2 * own.stiffness.cols());
    both << own.stiffness, own.rounding;
    solver_.sum({both.data(), static_cast<std::size_t>(both.size())});
    return both;
  }

  const LocalRows<Dim>& rows_;
  double norm_;
  double tolerance_;
  ParallelSolver& solver_;
  // lower bound on the eigenvalues of the preconditioned stiffness matrix, from the Ritz values found so far
  double ratio_ = 1.0;
  std::vector<Eigen::VectorXd> u_;  // response of the grains to each boundary unknown
  // for each boundary unknown, square root of twice the energy that further relaxation would release
  std::vector<double> excess_root_;
};

}  // namespace

template <int Dim>
ElasticResponse elastic_response(const ContactNetwork<Dim>& network, const std::vector<Vec<Dim>>& centres,
                                 const ResponseOptions& options, ParallelSolver& solver) {
  ElasticResponse out;
  out.free = find_free_motions(network);
  const bool has_ends =
      std::find(out.free.dead_end.begin(), out.free.dead_end.end(), true) != out.free.dead_end.end();
  ContactNetwork<Dim> pruned;
  if (has_ends) pruned = without_grains(network, out.free.dead_end);
  const ContactNetwork<Dim>& core = has_ends ? pruned : network;
  const double unit = stiffness_scale(core);
  const int n_boundary = n_boundary_unknowns(core, options.strains);
  const GrainShares shares = share_out(centres, in_contact(core), solver.size());
  // Conjugate gradients compute no factor of the stiffness matrix, so that its condition number and its negative
  // eigenvalues remain unknown. Only the negative eigenvalues of dead ends are known: one for each dead end whose
  // contact is an attraction across a gap.
  out.counted = false;
  out.condition = std::numeric_limits<double>::quiet_NaN();
  out.n_negative = out.free.n_unstable_ends;
  out.relaxed = out.error = Eigen::MatrixXd::Zero(n_boundary, n_boundary);
  out.fluctuation.resize(0, n_boundary);
  // If no grain has a contact, there is no matrix to solve with, and the response is zero. The calls under this
  // condition are collective. All processes compute equal shares, so that either all processes make these calls or none
  // does.
  if (!shares.grain.empty()) {
    const LocalRows<Dim> rows(core, out.free.kept, shares, solver.rank(), unit, options);
    double norm = rows.assemble(centres, solver);
    solver.maximum({&norm, 1});
    ParallelCondensation<Dim> condensed(rows, norm, options.tolerance, solver);
    out.failure = condensed.relax(n_boundary);
    if (!out.failure.empty()) return out;
    out.relaxed = unit * condensed.stiffness;
    out.error = unit * condensed.error;
    out.residual = condensed.residual;
    out.steps = condensed.steps;
  }
  relax_wall_shifts(network, out);
  return out;
}

template ElasticResponse elastic_response(const ContactNetwork<2>&, const std::vector<Vec<2>>&,
                                          const ResponseOptions&, ParallelSolver&);
template ElasticResponse elastic_response(const ContactNetwork<3>&, const std::vector<Vec<3>>&,
                                          const ResponseOptions&, ParallelSolver&);

}  // namespace floc
