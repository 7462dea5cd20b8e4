#include "floc/relaxation/spring_balance.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "floc/geometry/frame.h"
#include "floc/linalg/tangent_solver.h"
#include "floc/network/contact_network.h"
#include "floc/network/geometric_springs.h"
#include "floc/network/tangent_matrix.h"
#include "floc/packing/balance.h"
#include "floc/packing/grain_sizes.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/packing/law/contact_response.h"
#include "floc/packing/rotation.h"
#include "floc/relaxation/free_strains.h"
#include "floc/relaxation/free_walls.h"
#include "floc/relaxation/newton_move.h"
#include "floc/rigid/contact_points.h"
#include "floc/rigid/elastic_contacts.h"

namespace floc {
namespace {

/// Stiffness on the diagonal of the tangent matrix, divided by the stiffness of the stiffest contact: it keeps grains
/// without contacts in place.
constexpr double kIdleStiffness = 1e-12;
/// Net force that counts as a rounding error, divided by that of one contact whose gap is wrong by the rounding error of a
/// position.
constexpr double kRoundings = 4.0;

/// Equations of the static equilibrium of elastic grains with corners. The unknowns are the displacement and the rotation
/// (times the size) of each grain, followed by the strains of the axes under stress (FreeStrains) or, in a box, whose
/// periodic axes keep their lengths, by the displacements of the walls that move under a pressure.
template <int Dim>
class SpringProblem {
 public:
  /// State of the packing in an iteration.
  struct Configuration {
    /// Packing whose tangential forces are those of springs without Coulomb's limit.
    Packing<Dim> unlimited;
    Packing<Dim> packing;  ///< packing with the forces of the contact law
    Mat<Dim> stress;
    Residuals residuals;
    double worst = 0.0;  ///< largest residual
  };

  SpringProblem(const Packing<Dim>& start, const LoadTarget<Dim>& load)
      : load_(load), size_(contact_network(start).grain_size), walls_(start, load) {
    strains_.length = largest_diameter(start.grains);
    for (int a = 0; a < Dim; ++a) {
      if (load.strained(a) || !start.walls.empty()) continue;
      strains_.axes.push_back({a, a});
      strains_.stress.push_back(load.stress[a]);
    }
  }

  Configuration evaluated(Packing<Dim> unlimited) const {
    Configuration out;
    out.unlimited = std::move(unlimited);
    out.packing = out.unlimited;
    set_spring_forces(out.packing);
    out.stress = static_stress(out.packing);
    out.residuals = residuals(out.packing, load_.stress_with(out.stress), out.stress);
    out.worst = std::max({out.residuals.force, out.residuals.moment, out.residuals.stress});
    return out;
  }

  /// Returns the change of all unknowns in a Newton step: displacements of the grains, rotations times the sizes of the
  /// grains, and strains times the largest diameter. Absent if the tangent matrix is singular.
  std::optional<Eigen::VectorXd> newton_step(const Configuration& at) const {
    const TangentMatrix<Dim> tangent = tangent_matrix(at);
    const TangentLayout layout{kDofs<Dim>, n_boundary()};
    TangentSolver solver(Dim == 2 ? TangentPlan{} : plan_tangent(tangent.matrix(), layout), layout);
    if (!solver.set_matrix(tangent.matrix())) return std::nullopt;
    return solver.solve(net_loads(at));
  }

  /// Returns the largest relative displacement of two grains in contact, divided by the largest diameter.
  double largest_relative_displacement(const Configuration& at, const Eigen::VectorXd& step) const {
    double largest = 0.0;
    for (const Contact<Dim>& c : at.packing.contacts)
      largest = std::max(largest, slip_of(at.packing, c, step).norm());
    return largest / strains_.length;
  }

  /// Returns the configuration after the change `step` of all unknowns.
  Configuration moved(const Configuration& from, const Eigen::VectorXd& step) const {
    Packing<Dim> to = from.unlimited;
    const Mat<Dim> strain = strains_.strain_of(step);
    for (std::size_t k = 0; k < to.contacts.size(); ++k) {
      Contact<Dim>& c = to.contacts[k];
      const Vec<Dim> slip = slip_of(from.packing, c, step);
      c.shear_force += from.packing.contacts[k].kt * (slip - c.normal.dot(slip) * c.normal);
      RotationVector<Dim> turn = rotation(c.i, step);
      if (!to.is_wall(c.j)) turn += rotation(c.j, step);
      c.shear_force = rotated(c.shear_force, RotationVector<Dim>(0.5 * turn));
    }
    Grains<Dim>& g = to.grains;
    g.position_low.clear();
    for (int i = 0; i < g.size(); ++i) {
      g.position[i] += strain * g.position[i] + step.segment<Dim>(first_unknown<Dim>(i));
      g.orientation[i] = turned(g.orientation[i], rotation(i, step));
    }
    to.cell.matrix += to.cell.matrix * strain.transpose();
    walls_.move(step, to);
    const std::vector<Contact<Dim>> before = std::move(to.contacts);
    to.contacts = ContactPoints<Dim>().find(to, 0.0);
    carry_forces(to, before, to.contacts);
    return evaluated(std::move(to));
  }

 private:
  int n_boundary() const { return strains_.size() + walls_.size(); }

  RotationVector<Dim> rotation(int i, const Eigen::VectorXd& step) const {
    return step.segment<kRotations<Dim>>(first_unknown<Dim>(i) + Dim) / size_[static_cast<std::size_t>(i)];
  }
  /// Returns the displacement of the surface of the second body of a contact relative to that of the first.
  Vec<Dim> slip_of(const Packing<Dim>& packing, const Contact<Dim>& c, const Eigen::VectorXd& step) const {
    const auto of_grain = [&](int i, const Vec<Dim>& arm) {
      return Vec<Dim>(step.segment<Dim>(first_unknown<Dim>(i)) + cross<double>(rotation(i, step), arm));
    };
    if (packing.is_wall(c.j))
      return walls_.displacement(packing, c.j - packing.grains.size(), step) - of_grain(c.i, c.arm_i);
    return of_grain(c.j, c.arm_j) - of_grain(c.i, c.arm_i) + strains_.strain_of(step) * (c.arm_i - c.arm_j);
  }

  TangentMatrix<Dim> tangent_matrix(const Configuration& at) const {
    const Packing<Dim>& packing = at.packing;
    const ContactNetwork<Dim> network = contact_network(packing);
    const bool in_box = !packing.walls.empty();
    std::vector<Contact<Dim>> springs = at.unlimited.contacts;
    for (Contact<Dim>& c : springs) set_given_forces(packing, {}, {}, 0.0, c);
    std::vector<Mat<Dim>> frames;
    for (const NetworkContact<Dim>& c : network.contacts) frames.push_back(c.frame);
    const std::vector<SurfaceMotion<Dim>> unmoved(springs.size());
    std::vector<ContactTangent<Dim>> tangents(springs.size());
    contact_tangents<Dim>(packing, springs, unmoved, frames, tangents);
    TangentMatrix<Dim> out(size_, contact_graph(packing.grains.size(), network.contacts), n_boundary());
    out.reset(kIdleStiffness * stiffness_scale(network));
    for (std::size_t k = 0; k < springs.size(); ++k) {
      const NetworkContact<Dim>& c = network.contacts[k];
      out.add(c, tangents[k], geometric_stiffness(packing, c),
              in_box ? walls_.columns(c) : strains_.columns(c));
    }
    out.add_boundary(in_box ? walls_.load_derivatives(packing)
                            : strains_.load_derivatives(packing.cell.volume()));
    return out;
  }

  /// Returns the load on each unknown: net force, net moment divided by the size of the grain, and the difference
  /// between the stress and its target, multiplied by the volume and divided by the largest diameter, or the net force on
  /// a wall.
  Eigen::VectorXd net_loads(const Configuration& at) const {
    const Balance<Dim> net = net_forces(at.packing);
    const int n = at.packing.grains.size();
    Eigen::VectorXd out(kDofs<Dim> * n + n_boundary());
    for (int i = 0; i < n; ++i)
      out.segment<kDofs<Dim>>(first_unknown<Dim>(i)) << net.force[i],
          net.moment[i] / size_[static_cast<std::size_t>(i)];
    for (int s = 0; s < strains_.size(); ++s) {
      const int a = strains_.axes[s][0];
      out[kDofs<Dim> * n + s] =
          at.packing.cell.volume() * (at.stress(a, a) - strains_.stress[s]) / strains_.length;
    }
    out.tail(walls_.size()) = walls_.net_forces(at.packing);
    return out;
  }

  LoadTarget<Dim> load_;
  std::vector<double> size_;  // size of each grain
  FreeStrains<Dim> strains_;
  FreeWalls<Dim> walls_;
};

/// Returns the net force, in units of the force scale, that rounding of the positions may cause on a grain.
template <int Dim>
double rounding_of_forces(const Packing<Dim>& packing, const Vec<Dim>& stress) {
  double stiffness = 0.0;
  for (const Contact<Dim>& c : packing.contacts) stiffness = std::max(stiffness, c.kn);
  const double length = packing.cell.matrix.diagonal().maxCoeff();
  return kRoundings * std::numeric_limits<double>::epsilon() * stiffness * length /
         force_scale(packing, stress).force;
}

}  // namespace

template <int Dim>
SpringBalance<Dim> balance_springs(const Packing<Dim>& start, const LoadTarget<Dim>& load, double target) {
  const SpringProblem<Dim> problem(start, load);
  typename SpringProblem<Dim>::Configuration now = problem.evaluated(start);
  const double reachable = std::max(target, rounding_of_forces(now.packing, load.stress_with(now.stress)));
  const StaticSolverOptions options;
  for (int n = 0; n < options.max_iterations && now.worst > reachable; ++n) {
    const std::optional<Eigen::VectorXd> step = problem.newton_step(now);
    if (!step) break;
    auto move = newton_move(problem, now, *step, options);
    if (!move || move->next.worst >= now.worst) break;
    now = std::move(move->next);
  }
  return {std::move(now.packing), now.residuals, now.worst <= reachable};
}

template SpringBalance<2> balance_springs(const Packing<2>&, const LoadTarget<2>&, double);
template SpringBalance<3> balance_springs(const Packing<3>&, const LoadTarget<3>&, double);

}  // namespace floc
