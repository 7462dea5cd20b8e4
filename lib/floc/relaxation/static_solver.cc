#include "floc/relaxation/static_solver.h"

#include <fmt/format.h>

#include <Eigen/SparseCore>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "floc/base/error.h"
#include "floc/linalg/tangent_solver.h"
#include "floc/neighbors/pairs.h"
#include "floc/neighbors/unlisted_pairs.h"
#include "floc/network/tangent_matrix.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/packing/law/contact_response.h"
#include "floc/packing/liquid/liquid.h"
#include "floc/packing/locate.h"
#include "floc/packing/require_periodic.h"
#include "floc/relaxation/free_strains.h"
#include "floc/relaxation/newton_move.h"

namespace floc {
namespace {

/// Regularisation: this number times the stiffness of the stiffest contact is added on the diagonal of the tangent
/// matrix. Without this term, motions without stiffness would make the matrix singular. The number is far below the
/// relative stiffness of the softest mode of a packing (5e-6) and far above rounding errors.
constexpr double kRegularisation = 1e-10;

/// State of the packing in a Newton iteration: the cell, the positions of the grains, and the residuals of the
/// equations of equilibrium. For each candidate contact (contact, or pair that may come into contact), the
/// configuration also contains the relative motion of the two surfaces since the start of the iterations, and the
/// resulting forces.
template <int Dim>
struct Configuration {
  std::vector<DoubleDoubleVec<Dim>> centre;
  std::vector<Orientation<Dim>> orientation;
  Cell<Dim> cell;
  std::vector<Vec<Dim>> branch;  ///< branch vector of each candidate contact, from grain i to grain j (length)
  /// Candidate contacts (contacts, and pairs that may come into contact) with their present gap and normal, and with
  /// their history variables at the start of the iterations, rotated to the present normal.
  std::vector<Contact<Dim>> remembered;
  /// Relative motion of the two surfaces of each candidate contact since the start of the iterations.
  std::vector<SurfaceMotion<Dim>> motion;
  /// Candidate contacts (contacts, and pairs that may come into contact) with the forces and the history variables that
  /// result from `motion`.
  std::vector<Contact<Dim>> contacts;
  Eigen::VectorXd residual;
  double worst = 0.0;  ///< largest of all residuals, in the units of StaticSolverOptions::target
  int n_contacts = 0;
  int n_mobilised = 0;
};

/// Returns the reduced coordinates s of a point x = s * lattice vectors. The coordinates are computed by divisions by
/// the lattice components, so that s is below 1 for all points inside a rectangular cell. With an inverse matrix,
/// rounding errors could change this.
/// @param lower  lattice vectors, as the rows of a lower triangular matrix (length)
template <int Dim>
Vec<Dim> cell_coordinates(const Mat<Dim>& lower, const Vec<Dim>& x) {
  Vec<Dim> s;
  for (int a = Dim - 1; a >= 0; --a) {
    double rest = x[a];
    for (int b = a + 1; b < Dim; ++b) rest -= lower(b, a) * s[b];
    s[a] = rest / lower(a, a);
  }
  return s;
}

void rotate(double& orientation, const RotationVector<2>& rotation) {
  orientation += rotation[0];
}
void rotate(Eigen::Quaterniond& orientation, const RotationVector<3>& rotation) {
  const double angle = rotation.norm();
  if (angle > 0.0) orientation = Eigen::AngleAxisd(angle, rotation / angle) * orientation;
}

/// Returns the mean rotation of the two grains about the normal of their contact (radians); zero in 2D.
double twist_about(const Vec<2>&, const RotationVector<2>&, const RotationVector<2>&) {
  return 0.0;
}
double twist_about(const Vec<3>& normal, const RotationVector<3>& rotation_i,
                   const RotationVector<3>& rotation_j) {
  return 0.5 * normal.dot(rotation_i + rotation_j);
}

/// Equations of the static equilibrium of a packing. The unknowns are the displacement and the rotation (times the
/// radius) of each grain, followed by the free strains (times the largest diameter). Strain (a, b) displaces grains
/// along axis a in proportion to their coordinate along axis b. The equations are the balances of the force and of the
/// moment (divided by the radius) on each grain, and the balance of the virial with V Sigma (divided by the largest
/// diameter), where V is the volume and Sigma the imposed stress. The residuals of all equations are thus forces.
template <int Dim>
class StaticProblem {
 public:
  StaticProblem(const Packing<Dim>& start, const BoundaryControl<Dim>& control,
                const StaticSolverOptions& options)
      : start_(start),
        scale_(force_scale(start, Vec<Dim>(Vec<Dim>::Constant(control.mean_stress())))),
        quantities_(history_quantities(start.law, Dim)) {
    strains_.length = scale_.length;
    for (int k = 0; k < kSymmetric<Dim>; ++k) {
      if (control.imposed[k] != Imposed::stress) continue;
      strains_.axes.push_back(component_axes<Dim>(k));
      strains_.stress.push_back(control.target[k]);
    }
    initial_ = start_from(2.0 * options.largest_displacement * scale_.length);
    stiffness_ = 0.0;
    for (const Contact<Dim>& c : initial_.contacts) stiffness_ = std::max(stiffness_, c.kn);
    if (stiffness_ == 0.0) stiffness_ = scale_.force / scale_.length;
  }

  const Configuration<Dim>& initial() const { return initial_; }

  TangentMatrix<Dim> tangent_pattern() const {
    return {start_.grains.radius, contact_graph(n_grains(), initial_.remembered), n_strains()};
  }

  TangentLayout layout() const { return {kDofs<Dim>, n_strains()}; }

  /// Returns the smallest stress residual that can be reached (in the units of StaticSolverOptions::target). Each
  /// component of the lattice vectors is rounded to a double. The smallest residual is the stress caused by a strain of
  /// one rounding error. The elastic modulus is estimated by its upper bound in a packing of disks, which is twice the
  /// normal stiffness K_N.
  double rounding_of_stress() const {
    return 2.0 * std::numeric_limits<double>::epsilon() * stiffness_ * scale_.length / scale_.force;
  }

  /// Returns the configuration after the change `step` of all unknowns (positions, rotations and free strains).
  Configuration<Dim> moved(const Configuration<Dim>& from, const Eigen::VectorXd& step) const {
    return moved(from, step, strains_.strain_of(step));
  }

  /// Returns the configuration at the end of a strain ramp: the cell has its final lengths and offset, and the grains
  /// have been moved affinely with the cell.
  Configuration<Dim> strained(const Configuration<Dim>& from, const StrainRamp<Dim>& ramp) const {
    Mat<Dim> strain = Mat<Dim>::Zero();
    for (int a = 0; a < Dim; ++a)
      if (ramp.from[a] != ramp.to[a]) strain(a, a) = ramp.to[a] / ramp.from[a] - 1.0;
    if (ramp.shears()) strain(0, ramp.sheared_axis) = ramp.shear_strain();
    return moved(from, Eigen::VectorXd::Zero(order()), strain);
  }

  /// Returns the configuration after a displacement of the grains and a strain of the lattice.
  /// @param step  changes of all unknowns, of which only those of the grains are used
  /// @param wanted  strain of the lattice, which also moves the grains affinely
  Configuration<Dim> moved(const Configuration<Dim>& from, const Eigen::VectorXd& step,
                           const Mat<Dim>& wanted) const {
    Configuration<Dim> to = from;
    const Mat<Dim> lattice = from.cell.matrix;
    to.cell.matrix = lattice + lattice * wanted.transpose();
    // Strain from the old to the new components of the lattice. This strain differs slightly from `wanted`, since the
    // new components are rounded to doubles.
    const Mat<Dim> strain = strain_between(lattice, to.cell.matrix);
    // The unknown of the equations is the strain times the largest diameter. The strain is multiplied and divided by
    // this diameter, so that the strain contains the rounding error of the unknown.
    const Mat<Dim> unknown = strain * scale_.length;
    const Mat<Dim> applied = (wanted.array() != 0.0).select(unknown / scale_.length, Mat<Dim>::Zero());
    for (int i = 0; i < n_grains(); ++i) {
      Vec<Dim> high;
      for (int a = 0; a < Dim; ++a) high[a] = from.centre[i][a].high;
      const Vec<Dim> affine = strain * high;
      for (int a = 0; a < Dim; ++a)
        to.centre[i][a] = from.centre[i][a] + exact_sum(affine[a], step[first_unknown<Dim>(i) + a]);
      rotate(to.orientation[i], rotation_of(step, i));
    }
    for (std::size_t k = 0; k < to.remembered.size(); ++k) {
      Contact<Dim>& c = to.remembered[k];
      SurfaceMotion<Dim>& motion = to.motion[k];
      const Vec<Dim> normal = locate(to, k);
      const RotationVector<Dim> rotation_i = rotation_of(step, c.i), rotation_j = rotation_of(step, c.j);
      transport_history(quantities_, normal, twist_about(normal, rotation_i, rotation_j), c, motion);
      const double share = share_i(c);
      const RotationVector<Dim> mean_rotation = share * rotation_i + (1.0 - share) * rotation_j;
      motion.slip += to_shear<double>(normal, Vec<Dim>(relative_displacement(from, k, step, applied) -
                                                       cross<double>(mean_rotation, to.branch[k])));
      motion.relative_rotation += rolling_part<double>(normal, RotationVector<Dim>(rotation_i - rotation_j));
      if constexpr (Dim == 3) motion.twist += normal.dot(rotation_i - rotation_j);
    }
    evaluate(to);
    return to;
  }

  double largest_relative_displacement(const Configuration<Dim>& at, const Eigen::VectorXd& step) const {
    double largest = 0.0;
    for (std::size_t k = 0; k < at.contacts.size(); ++k)
      if (interacts(at.contacts[k]))
        largest = std::max(largest, relative_displacement(at, k, step, strains_.strain_of(step)).norm());
    return largest / scale_.length;
  }

  void assemble(const Configuration<Dim>& at, TangentMatrix<Dim>& matrix) const {
    std::vector<Mat<Dim>> frames;
    for (const Contact<Dim>& c : at.contacts) frames.push_back(contact_frame(c.normal));
    std::vector<ContactTangent<Dim>> tangents(frames.size());
    contact_tangents<Dim>(start_, at.remembered, at.motion, frames, tangents);
    matrix.reset(kRegularisation * stiffness_);
    for (std::size_t k = 0; k < frames.size(); ++k)
      if (interacts(at.contacts[k])) {
        const NetworkContact<Dim> contact = network_contact(at, k, frames[k]);
        matrix.add(contact, tangents[k], strains_.columns(contact));
      }
    matrix.add_boundary(strains_.load_derivatives(at.cell.volume()));
  }

  /// Whether any two grains interact although they are not a candidate contact. The candidates are all pairs that
  /// displacements within the limits of the solver can bring together. However, if no contact joins two parts of the
  /// packing, their relative motion has no stiffness, and a step may move the two parts by any distance. Without
  /// stress, this happens between a cluster of grains and its own periodic images.
  bool meets_others(const Configuration<Dim>& at) const {
    Packing<Dim> here;
    here.contacts = at.remembered;
    here.grains.radius = start_.grains.radius;
    for (const DoubleDoubleVec<Dim>& centre : at.centre) here.grains.position.push_back(rounded<Dim>(centre));
    try {
      return !unlisted_pairs(here, find_pairs(at.cell, here.grains, start_.law.range())).empty();
      // find_pairs() throws an InputError if the cell is so small that each grain has hundreds of neighbours.
    } catch (const InputError&) {
      return true;
    }
  }

  /// Returns the packing of a configuration. The packing is at rest, the history variables are updated, and the grains
  /// are inside the cell.
  Packing<Dim> packing(const Configuration<Dim>& at) const {
    Packing<Dim> out = start_;
    out.cell = at.cell;
    out.cell.velocity.setZero();
    out.contacts = at.contacts;
    for (Contact<Dim>& c : out.contacts) c.image += image_into_cell(at, c.i) - image_into_cell(at, c.j);
    std::vector<DoubleDoubleVec<Dim>> centres;
    for (int i = 0; i < n_grains(); ++i) {
      out.grains.velocity[i].setZero();
      out.grains.angular_velocity[i].setZero();
      centres.push_back(displaced<Dim>(at.centre[i], out.cell, image_into_cell(at, i)));
    }
    out.grains.orientation = at.orientation;
    out.grains.set_centres(centres);
    refresh_contacts(out);
    return out;
  }

 private:
  int n_grains() const { return start_.grains.size(); }
  int n_strains() const { return strains_.size(); }
  int order() const { return kDofs<Dim> * n_grains() + n_strains(); }
  double radii(const Contact<Dim>& c) const { return start_.grains.radius[c.i] + start_.grains.radius[c.j]; }
  double share_i(const Contact<Dim>& c) const {
    return lever_share(start_.grains.radius[c.i], start_.grains.radius[c.j]);
  }
  bool interacts(const Contact<Dim>& c) const { return floc::interacts(start_, c); }

  Configuration<Dim> start_from(double margin) const {
    Configuration<Dim> c;
    for (int i = 0; i < n_grains(); ++i) c.centre.push_back(start_.grains.centre(i));
    c.orientation = start_.grains.orientation;
    c.cell = start_.cell;
    c.remembered = candidates(margin);
    c.motion.resize(c.remembered.size());
    c.branch.resize(c.remembered.size());
    for (std::size_t k = 0; k < c.remembered.size(); ++k)
      transport_history(quantities_, locate(c, k), 0.0, c.remembered[k], c.motion[k]);
    evaluate(c);
    return c;
  }

  /// Returns the candidate contacts: the contacts of the packing, and the pairs that may come into contact.
  /// @param margin  distance by which the gap of a pair may shrink during the iterations (length)
  std::vector<Contact<Dim>> candidates(double margin) const {
    const auto image = [](const Vec<Dim, int>& v) {
      std::array<int, Dim> key;
      std::copy(v.begin(), v.end(), key.begin());
      return key;
    };
    std::multimap<std::tuple<int, int, std::array<int, Dim>>, const Contact<Dim>*> remembered;
    for (const Contact<Dim>& c : start_.contacts) remembered.insert({{c.i, c.j, image(c.image)}, &c});
    std::vector<Contact<Dim>> all;
    for (const NeighborPair<Dim>& p :
         find_pairs(start_.cell, start_.grains, interaction_range(start_) + margin)) {
      const auto [first, last] = remembered.equal_range({p.i, p.j, image(p.image)});
      for (auto known = first; known != last; ++known) all.push_back(*known->second);
      if (first != last) continue;
      all.emplace_back();
      all.back().i = p.i;
      all.back().j = p.j;
      all.back().image = p.image;
    }
    return all;
  }

  /// Sets the branch vector, the gap and the lever arms of candidate contact k.
  /// @return normal of the contact
  Vec<Dim> locate(Configuration<Dim>& at, std::size_t k) const {
    Contact<Dim>& c = at.remembered[k];
    const DoubleDoubleVec<Dim> r =
        difference<Dim>(displaced<Dim>(at.centre[c.j], at.cell, c.image), at.centre[c.i]);
    const ContactGeometry<Dim> found =
        locate_balls<Dim>(r, start_.grains.radius[c.i], start_.grains.radius[c.j]);
    at.branch[k] = found.branch;
    c.gap = found.gap;
    c.arm_i = found.arm_i;
    c.arm_j = found.arm_j;
    return found.normal;
  }

  /// Returns the number of lattice vectors along each axis by which grain i has to be moved into the cell.
  Vec<Dim, int> image_into_cell(const Configuration<Dim>& at, int i) const {
    Vec<Dim> high;
    for (int a = 0; a < Dim; ++a) high[a] = at.centre[i][a].high;
    return -cell_coordinates<Dim>(at.cell.matrix, high).array().floor().matrix().template cast<int>();
  }

  RotationVector<Dim> rotation_of(const Eigen::VectorXd& step, int i) const {
    return step.segment<kRotations<Dim>>(first_unknown<Dim>(i) + Dim) / start_.grains.radius[i];
  }
  /// Returns the strain e that deforms the lattice matrix `from` into `to` = `from` (1 + e)^T.
  static Mat<Dim> strain_between(const Mat<Dim>& from, const Mat<Dim>& to) {
    return from.template triangularView<Eigen::Lower>().solve(Mat<Dim>(to - from)).transpose();
  }

  Vec<Dim> relative_displacement(const Configuration<Dim>& at, std::size_t k, const Eigen::VectorXd& step,
                                 const Mat<Dim>& strain) const {
    const Contact<Dim>& c = at.remembered[k];
    return step.segment<Dim>(first_unknown<Dim>(c.j)) - step.segment<Dim>(first_unknown<Dim>(c.i)) +
           strain * at.branch[k];
  }

  static Vec<Dim> force_on_i(const Contact<Dim>& c) { return c.shear_force - c.normal_force * c.normal; }

  void evaluate(Configuration<Dim>& at) const {
    constexpr int kRotationDofs = kRotations<Dim>;
    at.contacts = at.remembered;
    respond<Dim>(start_, at.motion, at.contacts);
    at.residual = Eigen::VectorXd::Zero(order());
    at.n_contacts = at.n_mobilised = 0;
    auto stress_balance = at.residual.tail(n_strains());
    for (int k = 0; k < n_strains(); ++k)
      stress_balance[k] = -at.cell.volume() * strains_.stress[k] / scale_.length;
    const std::vector<double>& radius = start_.grains.radius;
    for (std::size_t k = 0; k < at.contacts.size(); ++k) {
      const Contact<Dim>& c = at.contacts[k];
      if (!interacts(c)) continue;
      const int first_i = first_unknown<Dim>(c.i), first_j = first_unknown<Dim>(c.j);
      const Vec<Dim> on_i = force_on_i(c);
      at.residual.template segment<Dim>(first_i) += on_i;
      at.residual.template segment<Dim>(first_j) -= on_i;
      // The lever arms are proportional to the radii. The moment of the shear force, divided by the radius, is
      // therefore equal for both grains.
      const RotationVector<Dim> shear_moment = moment<double>(at.branch[k], c.shear_force) / radii(c);
      const RotationVector<Dim> of_springs = spring_moment(c);
      at.residual.template segment<kRotationDofs>(first_i + Dim) += shear_moment + of_springs / radius[c.i];
      at.residual.template segment<kRotationDofs>(first_j + Dim) += shear_moment - of_springs / radius[c.j];
      for (int s = 0; s < n_strains(); ++s)
        stress_balance[s] -= on_i[strains_.axes[s][0]] * at.branch[k][strains_.axes[s][1]] / scale_.length;
      at.n_contacts += !c.distant;
      at.n_mobilised += c.is_mobilised();
    }
    measure(at);
  }

  /// Sets the largest residual of a configuration (Configuration::worst). For an inverted lattice this residual is set
  /// to infinity, so that a step to such a lattice is rejected even without contacts.
  void measure(Configuration<Dim>& at) const {
    if (!(at.cell.matrix.diagonal().minCoeff() > 0.0)) {
      at.worst = std::numeric_limits<double>::infinity();
      return;
    }
    at.worst = at.residual.tail(n_strains()).template lpNorm<Eigen::Infinity>() * std::pow(scale_.length, Dim) /
               at.cell.volume();
    for (int i = 0; i < n_grains(); ++i) {
      const int first = first_unknown<Dim>(i);
      at.worst = std::max(at.worst, at.residual.template segment<Dim>(first).norm());
      at.worst = std::max(at.worst, at.residual.template segment<kRotations<Dim>>(first + Dim).norm() *
                                        start_.grains.radius[i] / scale_.length);
    }
    at.worst /= scale_.force;
  }

  NetworkContact<Dim> network_contact(const Configuration<Dim>& at, std::size_t k,
                                      const Mat<Dim>& frame) const {
    const Contact<Dim>& c = at.contacts[k];
    NetworkContact<Dim> out;
    out.i = c.i;
    out.j = c.j;
    out.branch = at.branch[k];
    out.arm_i = c.arm_i;
    out.arm_j = c.arm_j;
    out.frame = frame;
    out.normal_force = c.normal_force;
    out.shear_force = c.shear_force;
    out.rolling_moment = c.rolling_moment;
    out.twisting_moment = c.twisting_moment;
    return out;
  }

  const Packing<Dim>& start_;
  ForceScale scale_;
  std::vector<HistoryQuantity> quantities_;  // history variables of contacts under the contact law
  FreeStrains<Dim> strains_;
  Configuration<Dim> initial_;
  double stiffness_;  // normal stiffness of the stiffest contact (force/length)
};

/// Returns the method by which linear systems with the tangent matrix are solved. In 2D the method is always a
/// factorization, because the triangular factors need little memory for any number of grains.
template <int Dim>
TangentPlan plan_of(const StaticProblem<Dim>& problem, const TangentMatrix<Dim>& tangent) {
  return Dim == 2 ? TangentPlan{} : plan_tangent(tangent.matrix(), problem.layout());
}

}  // namespace

template <int Dim>
TangentPlan plan_statics(const Packing<Dim>& start, const BoundaryControl<Dim>& control) {
  const StaticProblem<Dim> problem(start, control, {});
  return plan_of(problem, problem.tangent_pattern());
}

template <int Dim>
StaticSolution<Dim> solve_statics(const Packing<Dim>& start, const BoundaryControl<Dim>& control,
                                  const StaticSolverOptions& options) {
  assert(start.cell.matrix.isLowerTriangular(0.0));
  require_periodic(start, "the equations of static equilibrium are solved");
  const StaticProblem<Dim> problem(start, control, options);
  Configuration<Dim> now = problem.initial();
  TangentMatrix<Dim> tangent = problem.tangent_pattern();
  const TangentPlan plan = options.method ? TangentPlan{*options.method} : plan_of(problem, tangent);
  TangentSolver solver(plan, problem.layout());
  StaticSolution<Dim> solution;
  // The strain e of the ramp displaces two grains in contact by at most about e a, with the largest diameter a, which
  // is the unit of this sum of displacements. The sum is limited because only pairs of grains that were close at the
  // start can come into contact in the equations.
  double travelled = control.ramp.any() ? control.ramp.largest_strain() : 0.0;
  if (travelled > options.largest_displacement) {
    solution.reason = "the imposed lengths are too far from the present lengths of the cell";
    solution.has_lengths = false;
    solution.residual = now.worst;
    solution.packing = problem.packing(now);
    return solution;
  }
  if (control.ramp.any()) now = problem.strained(now, control.ramp);
  const double target_residual = std::max(options.target, problem.rounding_of_stress());
  for (; now.worst > target_residual; ++solution.iterations) {
    if (solution.iterations == options.max_iterations) {
      solution.reason = "the Newton iterations did not converge within the allowed number of iterations";
      break;
    }
    if (now.n_mobilised > options.largest_mobilised_share * now.n_contacts) {
      solution.reason =
          fmt::format("{} of {} contacts have a spring at its cap, too many for the Newton steps to converge",
                      now.n_mobilised, now.n_contacts);
      break;
    }
    problem.assemble(now, tangent);
    if (!solver.set_matrix(tangent.matrix())) {
      solution.reason = "the tangent matrix is singular";
      break;
    }
    const std::optional<Eigen::VectorXd> solved = solver.solve(now.residual);
    if (!solved) {
      solution.reason = "the iterative solution of the linear system for a Newton step did not converge";
      break;
    }
    auto move = newton_move(problem, now, *solved, options);
    if (!move) {
      solution.reason = "the packing has a mechanism (a motion without stiffness)";
      break;
    }
    travelled += move->length;
    if (move->next.worst >= now.worst || travelled > options.largest_displacement) {
      solution.reason = move->next.worst >= now.worst ? "a Newton step no longer reduces the residual"
                                                      : "the equilibrium is too far from the initial state";
      break;
    }
    now = std::move(move->next);
  }
  solution.converged = now.worst <= target_residual;
  if (solution.converged && problem.meets_others(now)) {
    solution.converged = false;
    solution.reason = "grains come into contact that were too far apart at the start of the iterations";
  }
  solution.residual = now.worst;
  solution.packing = problem.packing(now);
  return solution;
}

template TangentPlan plan_statics(const Packing<2>&, const BoundaryControl<2>&);
template TangentPlan plan_statics(const Packing<3>&, const BoundaryControl<3>&);
template StaticSolution<2> solve_statics(const Packing<2>&, const BoundaryControl<2>&,
                                         const StaticSolverOptions&);
template StaticSolution<3> solve_statics(const Packing<3>&, const BoundaryControl<3>&,
                                         const StaticSolverOptions&);

}  // namespace floc
