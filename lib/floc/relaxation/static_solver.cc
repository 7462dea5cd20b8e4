#include "floc/relaxation/static_solver.h"

#include <fmt/format.h>

#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <variant>
#include <vector>

#include "floc/contact/law_table.h"
#include "floc/linalg/unsymmetric_factor.h"
#include "floc/neighbors/pairs.h"
#include "floc/packing/contact_forces.h"

namespace floc {
namespace {

/// Stiffness, over K_N, that holds motions without any: far below the softest mode (5e-6 K_N), far above rounding.
constexpr double kHold = 1e-10;

/// A configuration: where the grains are, how far the surfaces slipped and turned since the start, and the
/// residual there.
struct Configuration {
  std::vector<TwoPartVec<2>> centre;
  std::vector<double> angle;
  Vec<2> side;
  std::vector<double> slip, turn;  ///< of each candidate contact
  Eigen::VectorXd residual;
  double worst = 0.0;  ///< largest residual in units of F1 and a
  int n_contacts = 0;
  int n_yielding = 0;
};

/// Unknowns of a 2D packing: x, y and angle (times the radius) of each grain, then the two strains times a length.
/// Equations: force, moment (over the radius), and virial minus A Sigma (over the length), all in units of force.
template <class Law>
class StaticProblem {
 public:
  static constexpr int kLocal = 8;  ///< dofs of one contact: two grains and two strains
  using LocalMatrix = Eigen::Matrix<double, kLocal, kLocal>;

  StaticProblem(const Packing<2>& start, const Law& law, const Vec<2>& target,
                const StaticSolverOptions& options)
      : start_(start), law_(law), target_(target), scale_(force_scale(start, target)) {
    const double margin = 2.0 * options.largest_displacement * scale_.length;
    std::map<std::tuple<int, int, int, int>, const Contact<2>*> remembered;
    for (const Contact<2>& c : start.contacts) remembered[{c.i, c.j, c.image[0], c.image[1]}] = &c;
    for (const NeighborPair<2>& p : find_pairs(start.cell, start.grains, law.range() + margin)) {
      Contact<2> c;
      if (const auto old = remembered.find({p.i, p.j, p.image[0], p.image[1]}); old != remembered.end())
        c = *old->second;
      c.i = p.i;
      c.j = p.j;
      c.image = p.image;
      candidates_.push_back(c);
    }
  }

  Configuration initial() const {
    Configuration c;
    for (int i = 0; i < n_grains(); ++i) c.centre.push_back(start_.grains.centre(i));
    c.angle = start_.grains.orientation;
    c.side = start_.cell.matrix.diagonal();
    c.slip.assign(candidates_.size(), 0.0);
    c.turn.assign(candidates_.size(), 0.0);
    evaluate(c);
    return c;
  }

  int n_grains() const { return start_.grains.size(); }
  int order() const { return 3 * n_grains() + 2; }

  /// Residual of the stress that the sides, which are kept as one double each, cannot be set below: that of a strain of
  /// one rounding, at most two stiffnesses K_N large in a disk packing.
  double rounding_of_stress() const {
    return 2.0 * std::numeric_limits<double>::epsilon() * law_.repulsion.normal_stiffness * scale_.length /
           scale_.force;
  }

  /// The configuration after a displacement of all unknowns, and the largest relative displacement it gives a
  /// contact.
  Configuration moved(const Configuration& from, Eigen::VectorXd step) const {
    Configuration to = from;
    const Vec<2> asked = step.tail<2>() / scale_.length;
    to.side = from.side + from.side.cwiseProduct(asked);
    const Vec<2> strain = (to.side - from.side).cwiseQuotient(from.side);  // of the sides as they are rounded
    step.tail<2>() = strain * scale_.length;
    for (int i = 0; i < n_grains(); ++i) {
      for (int a = 0; a < 2; ++a)
        to.centre[i][a] = from.centre[i][a] + exact_sum(from.centre[i][a].high * strain[a], step[3 * i + a]);
      to.angle[i] += step[3 * i + 2] / start_.grains.radius[i];
    }
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      const Contact<2>& c = candidates_[k];
      const Vec<2> r = rounded<2>(branch_of(to, c));
      const double distance = r.norm();
      const double arm_i = distance * share_i(c);
      const double turn_i = step[3 * c.i + 2] / start_.grains.radius[c.i];
      const double turn_j = step[3 * c.j + 2] / start_.grains.radius[c.j];
      to.slip[k] += tangent<double>(r / distance).dot(relative_displacement(from, c, step)) - arm_i * turn_i -
                    (distance - arm_i) * turn_j;
      to.turn[k] += turn_i - turn_j;
    }
    evaluate(to);
    return to;
  }

  double largest_relative_displacement(const Configuration& at, const Eigen::VectorXd& step) const {
    double largest = 0.0;
    for (const Contact<2>& c : candidates_) {
      if (gap_of(at, c) < law_.range()) largest = std::max(largest, relative_displacement(at, c, step).norm());
    }
    return largest / scale_.length;
  }

  Eigen::SparseMatrix<double> tangent_matrix(const Configuration& at) const {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(candidates_.size() * kLocal * kLocal + order());
    for (int k = 0; k < order(); ++k) entries.emplace_back(k, k, kHold * law_.repulsion.normal_stiffness);
    const Vec<2> area_load = at.side.prod() * target_ / (scale_.length * scale_.length);
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b) entries.emplace_back(order() - 2 + a, order() - 2 + b, area_load[a]);
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      const auto dofs = local_dofs(candidates_[k]);
      const LocalMatrix local = local_stiffness(at, k);
      for (int row = 0; row < kLocal; ++row)
        for (int column = 0; column < kLocal; ++column)
          entries.emplace_back(dofs[row], dofs[column], local(row, column));
    }
    Eigen::SparseMatrix<double> matrix(order(), order());
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }

  /// The packing of a configuration: at rest, springs mapped back, grains inside the cell.
  Packing<2> packing(const Configuration& at) const {
    Packing<2> out = start_;
    out.cell.matrix = at.side.asDiagonal();
    out.cell.velocity.setZero();
    out.contacts.clear();
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      Contact<2> c = candidates_[k];
      ContactHistory<Law, 2> history;
      respond(at, k, history);
      if constexpr (Law::kHasFriction) c.shear_spring = history.shear;
      if constexpr (Law::kHasRolling) c.rolling_spring = history.roll;
      c.image += inward(at, c.i) - inward(at, c.j);
      out.contacts.push_back(c);
    }
    std::vector<TwoPartVec<2>> centres;
    for (int i = 0; i < n_grains(); ++i) {
      out.grains.velocity[i].setZero();
      out.grains.angular_velocity[i].setZero();
      out.grains.orientation[i] = at.angle[i];
      centres.push_back(displaced<2>(at.centre[i], out.cell, inward(at, i)));
    }
    out.grains.set_centres(centres);
    refresh_contacts(out);
    return out;
  }

 private:
  double radii(const Contact<2>& c) const { return start_.grains.radius[c.i] + start_.grains.radius[c.j]; }
  double share_i(const Contact<2>& c) const { return start_.grains.radius[c.i] / radii(c); }

  /// Image that brings a grain into the cell.
  Vec<2, int> inward(const Configuration& at, int i) const {
    Vec<2, int> image;
    for (int a = 0; a < 2; ++a) image[a] = -static_cast<int>(std::floor(at.centre[i][a].high / at.side[a]));
    return image;
  }

  TwoPartVec<2> branch_of(const Configuration& at, const Contact<2>& c) const {
    TwoPartVec<2> r = difference<2>(at.centre[c.j], at.centre[c.i]);
    for (int a = 0; a < 2; ++a)
      if (c.image[a] != 0) r[a] = r[a] + exact_product(c.image[a], at.side[a]);
    return r;
  }

  double gap_of(const Configuration& at, const Contact<2>& c) const {
    return surface_gap<2>(branch_of(at, c), start_.grains.radius[c.i], start_.grains.radius[c.j]);
  }

  Vec<2> relative_displacement(const Configuration& at, const Contact<2>& c,
                               const Eigen::VectorXd& step) const {
    const Vec<2> strain = step.tail<2>() / scale_.length;
    return step.segment<2>(3 * c.j) - step.segment<2>(3 * c.i) +
           strain.cwiseProduct(rounded<2>(branch_of(at, c)));
  }

  std::array<int, kLocal> local_dofs(const Contact<2>& c) const {
    return {3 * c.i, 3 * c.i + 1, 3 * c.i + 2, 3 * c.j, 3 * c.j + 1, 3 * c.j + 2, order() - 2, order() - 1};
  }

  ContactForces<2> respond(const Configuration& at, std::size_t k, ContactHistory<Law, 2>& history) const {
    const Contact<2>& c = candidates_[k];
    if constexpr (Law::kHasFriction) history.shear = c.shear_spring;
    if constexpr (Law::kHasRolling) history.roll = c.rolling_spring;
    const ContactMotion<2> motion{gap_of(at, c), 0.0, 0.0, Shear<2>(at.slip[k]), Spin<2>(at.turn[k])};
    return law_.respond(motion, history);
  }

  void evaluate(Configuration& at) const {
    at.residual = Eigen::VectorXd::Zero(order());
    at.n_contacts = at.n_yielding = 0;
    at.residual.tail<2>() = -at.side.prod() * target_ / scale_.length;
    const std::vector<double>& radius = start_.grains.radius;
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      const Contact<2>& c = candidates_[k];
      const double gap = gap_of(at, c);
      if (gap >= law_.range()) continue;
      const Vec<2> r = rounded<2>(branch_of(at, c));
      const double distance = r.norm();
      const Vec<2> n = r / distance;
      ContactHistory<Law, 2> history;
      const ContactForces<2> f = respond(at, k, history);
      const Vec<2> on_i = f.shear[0] * tangent<double>(n) - f.normal.force() * n;
      const double per_radius = distance / radii(c);  // lever arm over radius, the same on both sides
      at.residual.segment<2>(3 * c.i) += on_i;
      at.residual.segment<2>(3 * c.j) -= on_i;
      at.residual[3 * c.i + 2] += per_radius * f.shear[0] - f.rolling[0] / radius[c.i];
      at.residual[3 * c.j + 2] += per_radius * f.shear[0] + f.rolling[0] / radius[c.j];
      at.residual.tail<2>() -= on_i.cwiseProduct(r) / scale_.length;
      at.n_contacts += gap < 0.0;
      at.n_yielding += yields(f);
    }
    measure(at);
  }

  void measure(Configuration& at) const {
    at.worst = at.residual.tail<2>().cwiseAbs().maxCoeff() * scale_.length * scale_.length / at.side.prod();
    for (int i = 0; i < n_grains(); ++i) {
      at.worst = std::max(at.worst, at.residual.segment<2>(3 * i).norm());
      at.worst = std::max(at.worst, std::abs(at.residual[3 * i + 2]) * start_.grains.radius[i] / scale_.length);
    }
    at.worst /= scale_.force;
  }

  /// A spring that came out of the mapping at its cap.
  bool slides(const ContactForces<2>& f) const {
    if constexpr (Law::kHasFriction)
      return f.normal.elastic > 0.0 &&
             std::abs(f.shear[0]) >= (1.0 - 1e-12) * law_.friction.coefficient * f.normal.elastic;
    return false;
  }
  bool rolls(const ContactForces<2>& f) const {
    if constexpr (Law::kHasRolling)
      return f.normal.elastic > 0.0 &&
             std::abs(f.rolling[0]) >= (1.0 - 1e-12) * law_.rolling.coefficient * f.normal.elastic;
    return false;
  }
  bool yields(const ContactForces<2>& f) const { return slides(f) || rolls(f); }

  /// Derivative of minus the residual by the contact's dofs. With dr = dx_j - dx_i + strain r, the force on i is
  /// f = -F n + S t, and df = -dF n - (F/r)(t.dr) t + dS t - (S/r)(t.dr) n.
  LocalMatrix local_stiffness(const Configuration& at, std::size_t k) const {
    const Contact<2>& c = candidates_[k];
    const double gap = gap_of(at, c);
    if (gap >= law_.range()) return LocalMatrix::Zero();
    const Vec<2> r = rounded<2>(branch_of(at, c));
    const double distance = r.norm();
    const Vec<2> n = r / distance;
    const Vec<2> t = tangent<double>(n);
    ContactHistory<Law, 2> history;
    const ContactForces<2> f = respond(at, k, history);
    const double radius_i = start_.grains.radius[c.i];
    const double radius_j = start_.grains.radius[c.j];
    const double per_radius = distance / radii(c);
    const double elastic_stiffness = law_.repulsion.stiffness(gap);

    // Derivatives by (dr_x, dr_y, angle_i * R_i, angle_j * R_j).
    using Row = Eigen::Matrix<double, 1, 4>;
    const Row along(n[0], n[1], 0.0, 0.0);
    const Row across(t[0], t[1], 0.0, 0.0);
    Row shear = Row::Zero(), rolling = Row::Zero();
    if constexpr (Law::kHasFriction) {
      if (slides(f))
        shear = -std::copysign(law_.friction.coefficient * elastic_stiffness, f.shear[0]) * along;
      else if (f.normal.elastic > 0.0)
        shear = law_.friction.tangential_stiffness * (across - Row(0.0, 0.0, per_radius, per_radius));
    }
    if constexpr (Law::kHasRolling) {
      if (rolls(f))
        rolling = -std::copysign(law_.rolling.coefficient * elastic_stiffness, f.rolling[0]) * along;
      else if (f.normal.elastic > 0.0)
        rolling = law_.rolling.rolling_stiffness * Row(0.0, 0.0, 1.0 / radius_i, -1.0 / radius_j);
    }
    Eigen::Matrix<double, 2, 4> force = n * (f.normal.stiffness * along) -
                                        t * (f.normal.force() / distance * across) + t * shear -
                                        n * (f.shear[0] / distance * across);
    const Row arm = per_radius * shear + f.shear[0] / radii(c) * along;

    Eigen::Matrix<double, kLocal, 4> rows;  // minus the derivative of each equation
    rows.row(0) = -force.row(0);
    rows.row(1) = -force.row(1);
    rows.row(2) = -(arm - rolling / radius_i);
    rows.row(3) = force.row(0);
    rows.row(4) = force.row(1);
    rows.row(5) = -(arm + rolling / radius_j);
    const Vec<2> on_i = f.shear[0] * t - f.normal.force() * n;
    for (int a = 0; a < 2; ++a) {
      rows.row(6 + a) = force.row(a) * (r[a] / scale_.length);
      rows(6 + a, a) += on_i[a] / scale_.length;
    }
    Eigen::Matrix<double, 4, kLocal> columns = Eigen::Matrix<double, 4, kLocal>::Zero();
    for (int a = 0; a < 2; ++a) {
      columns(a, a) = -1.0;
      columns(a, 3 + a) = 1.0;
      columns(a, 6 + a) = r[a] / scale_.length;
    }
    columns(2, 2) = columns(3, 5) = 1.0;
    return rows * columns;
  }

  const Packing<2>& start_;
  const Law& law_;
  Vec<2> target_;
  ForceScale scale_;
  std::vector<Contact<2>> candidates_;
};

template <class Law>
StaticSolution<2> solve(const Packing<2>& start, const Law& law, const Vec<2>& target,
                        const StaticSolverOptions& options) {
  const StaticProblem<Law> problem(start, law, target, options);
  Configuration now = problem.initial();
  UnsymmetricFactor factor;
  StaticSolution<2> solution;
  double travelled = 0.0;
  const double target_residual = std::max(options.target, problem.rounding_of_stress());
  for (; now.worst > target_residual; ++solution.iterations) {
    if (solution.iterations == options.max_iterations) {
      solution.reason = "no convergence within the iterations allowed";
      break;
    }
    if (now.n_yielding > options.largest_yielding_share * now.n_contacts) {
      solution.reason = fmt::format("{} of {} contacts yield", now.n_yielding, now.n_contacts);
      break;
    }
    if (!factor.factorize(problem.tangent_matrix(now))) {
      solution.reason = "the tangent is singular";
      break;
    }
    Eigen::VectorXd step = factor.solve(now.residual);
    double length = problem.largest_relative_displacement(now, step);
    if (!(length < 1e3)) {
      solution.reason = "a motion without stiffness";
      break;
    }
    if (length > options.largest_step) {
      step *= options.largest_step / length;
      length = options.largest_step;
    }
    int halvings = 0;
    Configuration next = problem.moved(now, step);
    while (next.worst >= now.worst && halvings < options.max_backtracking) {
      step *= 0.5;
      length *= 0.5;
      next = problem.moved(now, step);
      ++halvings;
    }
    travelled += length;
    if (next.worst >= now.worst || travelled > options.largest_displacement) {
      solution.reason =
          next.worst >= now.worst ? "the residual stopped falling" : "the state lies too far away";
      break;
    }
    now = std::move(next);
  }
  solution.converged = now.worst <= target_residual;
  solution.residual = now.worst;
  solution.packing = problem.packing(now);
  return solution;
}

}  // namespace

template <int Dim>
StaticSolution<Dim> solve_statics(const Packing<Dim>& start, const Vec<Dim>& target_stress,
                                  const StaticSolverOptions& options) {
  return std::visit([&](const auto& law) { return solve(start, law, target_stress, options); },
                    compose_law(start.law));
}

template StaticSolution<2> solve_statics(const Packing<2>&, const Vec<2>&, const StaticSolverOptions&);

}  // namespace floc
