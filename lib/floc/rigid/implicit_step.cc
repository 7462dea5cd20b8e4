#include "floc/rigid/implicit_step.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "floc/geometry/frame.h"
#include "floc/rigid/interior_point.h"

namespace floc {
namespace {

/// Largest number of times that a step with friction is solved.
constexpr int kMostSolutions = 30;
/// A step with friction is not solved again if the errors of the opening velocities (implicit_step.h) are below this
/// value, in the units of the program.
constexpr double kSameOpening = 1e-6;
/// Limits of the derivative of the error mu |u_t| - s with respect to the opening velocity s of the same contact. The
/// derivative is -1 if the slip does not depend on the opening, and below -1 if a contact that opens more slips less.
constexpr double kSteepestError = -10.0, kFlattestError = -0.3;

/// If rounding errors ended the iteration, a solution is still accepted if the errors of its impulses and of the
/// objective are at most this value, in the units of the program. The next step corrects the error.
constexpr double kAcceptedError = 1e-5;

/// One unknown of a step: the velocity of a body along an axis of space, the angular velocity of a body about a
/// principal axis, or the rate of stretch of the cell along an axis. Angular velocities and rates of stretch are
/// multiplied by a length, so that all unknowns have the unit of a velocity.
template <int Dim>
struct Unknown {
  Vec<Dim> direction = Vec<Dim>::Zero();                   ///< axis of a translation
  RotationVector<Dim> axis = RotationVector<Dim>::Zero();  ///< axis of a rotation
  int stretch = -1;                                        ///< axis of a stretch; -1 for other unknowns
  int body = -1;
  double mass = 0.0;    ///< momentum divided by velocity (mass)
  double length = 1.0;  ///< factor by which an angular velocity or a rate of stretch is multiplied (length)
};

/// Cone program for the impulses p of a step. Row r is the balance of momentum for the unknown velocity v_r with the
/// mass M_r: sum H p - M_r v_r = -M_r v_free. The sum is over the contacts, H is the relative velocity at a contact for
/// v_r = 1, and v_free is the value of v_r without impulses. The dual unknown of the row is -v_r. The units of impulses
/// and velocities are chosen so that their values are of order one.
template <int Dim>
class StepProgram {
 public:
  StepProgram(const BodyMotion<Dim>& bodies, const std::vector<StepContact<Dim>>& contacts,
              const std::vector<PairMatrix<Dim>>& stiffness)
      : bodies_(bodies),
        contacts_(contacts),
        first_(static_cast<std::size_t>(bodies.size()), -1),
        ends_(first_.size(), 0),
        openings_(contacts.size()) {
    set_units();
    for (const StepContact<Dim>& c : contacts_)
      for (const int body : {c.i, c.j}) first_[body] = 0;
    add_unknowns();
    add_blocks();
    for (std::size_t k = 0; k < stiffness.size(); ++k) add_stiffness(static_cast<int>(k), stiffness[k]);
  }

  const ConeProgram<Dim>& program() const { return program_; }

  /// Changes the opening velocities in the program. In a solution of the step, the opening velocity of each contact
  /// equals mu |u_t|, with the friction coefficient mu and the slip velocity u_t. The new value follows by the secant
  /// method from the errors of the last two values. (With mu |u_t| itself as the new value, the values of a contact on
  /// soft surroundings would alternate without end: the contact slides without the opening, and sticks with it.)
  /// @return largest error of an opening velocity in the given solution
  double improve_openings(const ConeSolution<Dim>& solution) {
    const std::vector<Vec<Dim>> motion = program_.relative_motion(Eigen::VectorXd(-solution.motion));
    double largest = 0.0;
    for (std::size_t k = 0; k < contacts_.size(); ++k) {
      const Vec<Dim> own = bias(contacts_[k]);
      // An elastic spring takes up a part of the relative motion.
      const Vec<Dim> slip = motion[k] + own + program_.compliance[k].cwiseProduct(solution.x[k]);
      Opening& last = openings_[k];
      const double value = program_.linear[k][0] - own[0];
      const double error = slip.template tail<Dim - 1>().norm() - value;
      double slope = -1.0;
      if (value != last.value)
        slope = std::clamp((error - last.error) / (value - last.value), kSteepestError, kFlattestError);
      last = {value, error};
      program_.linear[k][0] = own[0] + std::max(0.0, value - error / slope);
      largest = std::max(largest, std::abs(error));
    }
    return largest;
  }

  /// Sets the impulses of the contacts and the velocities at the end of the step.
  void set_solution(const ConeSolution<Dim>& solution, BodyMotion<Dim>& bodies,
                    std::vector<StepContact<Dim>>& contacts) const {
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      contacts[k].impulse = impulse_ * solution.x[k];
      contacts[k].impulse.template tail<Dim - 1>() *= contacts[k].friction;
    }
    for (std::size_t r = 0; r < unknowns_.size(); ++r) {
      const Unknown<Dim>& u = unknowns_[r];
      const double change = -solution.motion[r] * velocity_ - free_[r];
      if (u.stretch >= 0)
        bodies.stretch[u.stretch] += change / u.length;
      else {
        bodies.velocity[u.body] += change * u.direction;
        bodies.angular_velocity[u.body] += change / u.length * u.axis;
      }
    }
  }

 private:
  /// An opening velocity in the last program, and its error mu |u_t| - s in the solution of this program.
  struct Opening {
    double value = 0.0;
    double error = 0.0;
  };

  /// Sets the unit of impulses to the mean of the nonzero initial impulses, and the unit of velocities to the largest
  /// velocity that closes a gap. If all these impulses or velocities are zero, the unit follows from the velocities
  /// without impulses.
  void set_units() {
    double impulses = 0.0, momentum = 0.0, speed = 0.0;
    int n = 0;
    for (const StepContact<Dim>& c : contacts_) {
      if (c.impulse[0] > 0.0) impulses += c.impulse[0], ++n;
      velocity_ = std::max(velocity_, std::abs(c.bias[0]));
      for (const int body : {c.i, c.j}) {
        const double inverse_mass = bodies_.inverse_mass[body].maxCoeff();
        const double free = bodies_.velocity[body].norm();
        speed = std::max(speed, free);
        if (inverse_mass > 0.0) momentum = std::max(momentum, free / inverse_mass);
      }
    }
    impulse_ = n > 0 ? impulses / n : momentum > 0.0 ? momentum : 1.0;
    if (!(velocity_ > 0.0)) velocity_ = speed > 0.0 ? speed : 1.0;
  }

  /// Returns the part of the relative velocity at a contact that impulses do not change, in the frame of the contact.
  Vec<Dim> imposed_velocity(const StepContact<Dim>& c) const {
    const auto of_body = [&](int i, const Vec<Dim>& arm) {
      Vec<Dim> v = (bodies_.inverse_mass[i].array() > 0.0).select(Vec<Dim>::Zero(), bodies_.velocity[i]);
      if (bodies_.inverse_inertia[i].isZero(0.0)) v += cross<double>(bodies_.angular_velocity[i], arm);
      return v;
    };
    const Vec<Dim> stretch =
        (bodies_.inverse_stretch_mass.array() > 0.0).select(Vec<Dim>::Zero(), bodies_.stretch);
    return c.frame.transpose() *
           (of_body(c.j, c.arm_j) - of_body(c.i, c.arm_i) + stretch.cwiseProduct(c.branch));
  }

  Vec<Dim> bias(const StepContact<Dim>& c) const {
    Vec<Dim> b = (c.bias + imposed_velocity(c)) / velocity_;
    b.template tail<Dim - 1>() *= c.friction;
    return b;
  }

  void add(const Unknown<Dim>& unknown, double free, int group) {
    unknowns_.push_back(unknown);
    free_.push_back(free);
    program_.group.push_back(group);
  }

  void add_unknowns() {
    int group = 0;
    for (int i = 0; i < bodies_.size(); ++i) {
      // A body without contacts gets no impulses and keeps its velocity. The program therefore does not contain this
      // velocity.
      if (first_[i] < 0) continue;
      first_[i] = static_cast<int>(unknowns_.size());
      for (int a = 0; a < Dim; ++a)
        if (bodies_.inverse_mass[i][a] > 0.0)
          add({.direction = Vec<Dim>::Unit(a), .body = i, .mass = 1.0 / bodies_.inverse_mass[i][a]},
              bodies_.velocity[i][a], group);
      const Eigen::SelfAdjointEigenSolver<Mat<kRotations<Dim>>> axes(bodies_.inverse_inertia[i]);
      for (int a = 0; a < kRotations<Dim>; ++a)
        if (const double inverse = axes.eigenvalues()[a]; inverse > 0.0) {
          // For a grain of the mass m, this length is the radius of gyration sqrt(I/m) about the principal axis with
          // the moment of inertia I. The mass of the unknown is then I/length^2 = m, as for translations.
          const double length = std::sqrt(bodies_.inverse_mass[i].maxCoeff() / inverse);
          add({.axis = axes.eigenvectors().col(a),
               .body = i,
               .mass = 1.0 / (inverse * length * length),
               .length = length},
              axes.eigenvectors().col(a).dot(bodies_.angular_velocity[i]) * length, group);
        }
      ends_[i] = static_cast<int>(unknowns_.size());
      if (ends_[i] > first_[i]) ++group;
    }
    first_stretch_ = static_cast<int>(unknowns_.size());
    for (int a = 0; a < Dim; ++a)
      if (const double inverse = bodies_.inverse_stretch_mass[a]; inverse > 0.0) {
        double branch = 0.0;
        for (const StepContact<Dim>& c : contacts_) branch = std::max(branch, std::abs(c.branch[a]));
        // All n contacts contribute to the row of a stretch, with the coefficients r_a/length for the components r_a of
        // the branch vectors. With length = max|r_a| sqrt(n), the norm of the row is of order one for any number of
        // contacts. The coefficients of the other unknowns are of order one, too.
        const double length = branch * std::sqrt(static_cast<double>(contacts_.size()));
        add({.stretch = a, .mass = 1.0 / (inverse * length * length), .length = length},
            bodies_.stretch[a] * length, group++);
      }
    const int n = static_cast<int>(unknowns_.size());
    program_.softness.resize(n);
    program_.load.resize(n);
    for (int r = 0; r < n; ++r) {
      program_.softness[r] = unknowns_[r].mass * velocity_ / impulse_;
      program_.load[r] = -unknowns_[r].mass * free_[r] / impulse_;
    }
  }

  /// Returns the relative velocity at a contact if one unknown is 1 and all others are 0, in the frame of the contact.
  Vec<Dim> relative_velocity(const StepContact<Dim>& c, const Unknown<Dim>& u) const {
    Vec<Dim> out = Vec<Dim>::Zero();
    if (u.stretch >= 0) {
      out[u.stretch] = c.branch[u.stretch] / u.length;
    } else {
      if (u.body == c.j) out += u.direction + cross<double>(RotationVector<Dim>(u.axis / u.length), c.arm_j);
      if (u.body == c.i) out -= u.direction + cross<double>(RotationVector<Dim>(u.axis / u.length), c.arm_i);
    }
    return c.frame.transpose() * out;
  }

  void add_blocks() {
    for (const StepContact<Dim>& c : contacts_) {
      const auto visit = [&](int r) {
        const Vec<Dim> u = relative_velocity(c, unknowns_[r]);
        program_.load[r] += u[0] * c.adhesion / impulse_;
        Vec<Dim> coefficient = u;
        coefficient.template tail<Dim - 1>() *= c.friction;
        program_.row.push_back(r);
        program_.coefficient.push_back(coefficient);
      };
      for (int r = first_[c.i]; r < ends_[c.i]; ++r) visit(r);
      if (c.j != c.i)
        for (int r = first_[c.j]; r < ends_[c.j]; ++r) visit(r);
      for (int r = first_stretch_; r < static_cast<int>(unknowns_.size()); ++r) visit(r);
      program_.first.push_back(static_cast<int>(program_.row.size()));
      Vec<Dim> compliance = Vec<Dim>::Constant(c.friction * c.friction * c.tangential_compliance);
      compliance[0] = c.normal_compliance;
      program_.compliance.push_back(compliance * impulse_ / velocity_);
      program_.linear.push_back(bias(c));
    }
  }

  /// Returns the motion of the two bodies of a contact if one unknown is 1 and all others are 0.
  PairMotion<Dim> motion_of_pair(const StepContact<Dim>& c, const Unknown<Dim>& u) const {
    PairMotion<Dim> out = PairMotion<Dim>::Zero();
    for (const int side : {0, 1})
      if (u.stretch < 0 && u.body == (side == 0 ? c.i : c.j)) {
        out.template segment<Dim>(side * kDofs<Dim>) += u.direction;
        out.template segment<kRotations<Dim>>(side * kDofs<Dim> + Dim) += u.axis / u.length;
      }
    return out;
  }

  void add_stiffness(int k, const PairMatrix<Dim>& matrix) {
    for (int e = program_.first[k]; e < program_.first[k + 1]; ++e) {
      const PairMotion<Dim> load = matrix * motion_of_pair(contacts_[k], unknowns_[program_.row[e]]);
      for (int f = program_.first[k]; f <= e; ++f)
        program_.block_softness.push_back(load.dot(motion_of_pair(contacts_[k], unknowns_[program_.row[f]])) *
                                          velocity_ / impulse_);
    }
  }

  const BodyMotion<Dim>& bodies_;
  const std::vector<StepContact<Dim>>& contacts_;
  /// for each body, the index of its first unknown, and one more than the index of its last unknown
  std::vector<int> first_, ends_;
  int first_stretch_ = 0;
  std::vector<Unknown<Dim>> unknowns_;
  std::vector<double> free_;  ///< value of each unknown without impulses (length/time)
  double impulse_ = 1.0, velocity_ = 0.0;
  std::vector<Opening> openings_;  ///< for each contact
  ConeProgram<Dim> program_;
};

}  // namespace

template <int Dim>
bool solve_at_once(BodyMotion<Dim>& bodies, std::vector<StepContact<Dim>>& contacts,
                   const std::vector<PairMatrix<Dim>>& stiffness) {
  if (contacts.empty()) return true;
  StepProgram<Dim> step(bodies, contacts, stiffness);
  InteriorPoint<Dim> method(step.program());
  const bool slides = std::ranges::any_of(contacts, [](const auto& c) { return c.friction > 0.0; });
  ConeSolution<Dim> solution = method.solve(step.program());
  for (int n = 1; slides && n < kMostSolutions && solution.is_solved(kAcceptedError, kAcceptedError); ++n) {
    if (step.improve_openings(solution) < kSameOpening) break;
    solution = method.solve(step.program());
  }
  if (!solution.is_solved(kAcceptedError, kAcceptedError)) return false;
  step.set_solution(solution, bodies, contacts);
  return true;
}

template bool solve_at_once(BodyMotion<2>&, std::vector<StepContact<2>>&, const std::vector<PairMatrix<2>>&);
template bool solve_at_once(BodyMotion<3>&, std::vector<StepContact<3>>&, const std::vector<PairMatrix<3>>&);

}  // namespace floc
