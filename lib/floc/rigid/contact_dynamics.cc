#include "floc/rigid/contact_dynamics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "floc/base/error.h"
#include "floc/geometry/frame.h"
#include "floc/network/contact_network.h"
#include "floc/packing/body_name.h"
#include "floc/packing/grain_sizes.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/packing/rotation.h"
#include "floc/packing/wall_forces.h"
#include "floc/rigid/common_factor.h"
#include "floc/rigid/elastic_contacts.h"
#include "floc/rigid/implicit_step.h"

namespace floc {
namespace {

/// Largest allowed displacement of a grain in a time step, divided by the diameter of the grain.
constexpr double kLongestMove = 2e-2;
/// Largest allowed displacement, divided by the diameter, of a grain with corners on which a contact force acts. The
/// limit is lower than kLongestMove because the closest features of two grains may change within a step.
constexpr double kCarryingMove = 5e-3;
/// If there are more than kManyGrains grains, one in kGrainsPerFast may move kFurther times as far as its limit in a
/// step that is solved by sweeps, and the limit of grains with corners is kLongestMove, too. The fastest of many grains
/// would otherwise make all steps short.
constexpr int kGrainsPerFast = 20;
constexpr double kFurther = 4.0;
/// Deepest overlap of two grains, divided by the diameter of the smaller grain, that is allowed after a step.
constexpr double kDeepest = 1e-2;
/// Deepest overlap, divided by the diameter of the smaller grain, that is allowed after a step from rest. A step from
/// rest is made if shorter steps did not avoid overlaps, for example because two nearly parallel faces meet at a
/// different corner in each step.
constexpr double kDeepestAtRest = 5e-2;
/// Deepest overlap of elastic grains, divided by the diameter of the smaller grain.
constexpr double kDeepestElastic = 0.1;
/// Largest number of times that a step is halved because overlaps after it are too deep.
constexpr int kMostHalvings = 5;
/// Shortest step, divided by the longest step, that is still halved if overlaps after it are too deep.
constexpr double kShortestStep = 1e-3;
/// Share of an overlap that a step removes if the step is solved by sweeps.
constexpr double kStabilisation = 0.1;
/// If impacts are elastic, this part of each overlap (divided by the diameter of the smaller grain) is not removed. Its
/// removal would add energy.
constexpr double kElasticOverlap = 5e-3;
/// Value of shortest_removal() divided by the longest time step.
constexpr double kShortestRemoval = 0.125;
/// If the largest displacement in a step is less than this share of its limit, the next time step is doubled.
constexpr double kTimid = 0.4;
/// The initial impulses are multiplied by a common factor if the sweeps that would otherwise adapt the stress to the
/// motion of the cell (has_slow_cell()) are more than this number.
constexpr double kSlowCell = 500.0;
/// A contact counts as sliding if its tangential impulse differs from Coulomb's limit by less than this fraction of the
/// limit.
constexpr double kAtLimit = 1e-9;

/// Returns whether the adhesion of a contact acts in a step. It acts if the surfaces touch, or if a repulsive force
/// acted between them in the last step.
template <int Dim>
bool sticks(const Contact<Dim>& c) {
  return c.gap <= 0.0 || c.elastic_force > 0.0;
}

/// Stops all grains, the cell, and the walls that move under a force.
template <int Dim>
void stop_all(Packing<Dim>& packing) {
  stop_grains(packing);
  for (Wall<Dim>& wall : packing.walls)
    if (follows_forces(wall)) wall.velocity = 0.0;
}

/// Returns whether the grains, as a whole, move backwards: the sum of m (v . v' + R^2 w . w') over the grains is
/// negative, with the mass m, the radius R, the present and earlier velocities v and v', and the present and earlier
/// spins w and w'.
template <int Dim>
bool turns_back(const Packing<Dim>& before, const Packing<Dim>& now) {
  double product = 0.0;
  for (int i = 0; i < now.grains.size(); ++i) {
    const double size = now.grains.radius[i];
    product += now.grains.mass[i] *
               (now.grains.velocity[i].dot(before.grains.velocity[i]) +
                size * size * now.grains.angular_velocity[i].dot(before.grains.angular_velocity[i]));
  }
  return product < 0.0;
}

}  // namespace

double shortest_removal(const ContactDynamicsSettings& settings) {
  return kShortestRemoval * settings.longest_step;
}

template <int Dim>
ContactDynamics<Dim>::ContactDynamics(Packing<Dim> packing, const BoundaryLoad<Dim>& load,
                                      const ContactDynamicsSettings& settings, double time_step,
                                      double last_step)
    : packing_(std::move(packing)),
      load_(load),
      settings_(settings),
      time_step_(time_step),
      last_step_(last_step > 0.0 ? last_step : time_step),
      grain_mass_(total_mass(packing_.grains)) {
  find_contacts(packing_);
}

/// Replaces the contacts of a packing by all contact points within reach. The new points get the forces of the old
/// contacts.
template <int Dim>
void ContactDynamics<Dim>::find_contacts(Packing<Dim>& packing) {
  std::vector<Contact<Dim>> contacts = points_.find(packing, reach());
  carry_forces(packing, packing.contacts, contacts);
  packing.contacts = std::move(contacts);
  if (!packing.law.is_rigid()) set_spring_forces(packing);
}

/// Returns the largest gap of contact points that take part in a step: two grains can approach each other by at most
/// this distance in a step.
template <int Dim>
double ContactDynamics<Dim>::reach() const {
  const double largest = *std::max_element(packing_.grains.radius.begin(), packing_.grains.radius.end());
  return 2.0 * kLongestMove * 2.0 * largest;
}

/// Returns the velocity gradient of the cell that is added to the velocities of the grains (1/time). The components
/// along axes with walls are zero: along these axes, the velocities of the grains are relative to space.
template <int Dim>
Mat<Dim> ContactDynamics<Dim>::cell_rate() const {
  Mat<Dim> rate = packing_.cell.rate();
  for (int a = 0; a < Dim; ++a)
    if (between_walls(packing_.walls, a)) rate(a, a) = 0.0;
  return rate;
}

/// Returns the velocities that the grains, the walls and the cell would have at the end of a step without contacts.
template <int Dim>
BodyMotion<Dim> ContactDynamics<Dim>::free_motion(double dt, bool at_rest) const {
  const Grains<Dim>& g = packing_.grains;
  BodyMotion<Dim> out;
  for (int i = 0; i < g.size(); ++i) {
    Vec<Dim> v = at_rest ? Vec<Dim>(Vec<Dim>::Zero()) : g.velocity[i];
    RotationVector<Dim> w = at_rest ? RotationVector<Dim>(RotationVector<Dim>::Zero()) : g.angular_velocity[i];
    v += dt * packing_.gravity;
    const Mat<kRotations<Dim>> inertia = g.inertia_tensor(i);
    const Mat<kRotations<Dim>> inverse = inertia.inverse();
    // By Euler's equations, the spin of a body with different principal moments of inertia changes even without a
    // moment.
    if constexpr (Dim == 3)
      if (!g.are_round()) w -= dt * inverse * w.cross(inertia * w);
    out.velocity.push_back(v);
    out.angular_velocity.push_back(w);
    out.inverse_mass.push_back(Vec<Dim>::Constant(1.0 / g.mass[i]));
    out.inverse_inertia.push_back(inverse);
  }
  add_walls(dt, at_rest, out);
  add_cell(dt, at_rest, out);
  return out;
}

/// Returns the terminal speed of a wall: the speed at which a wall that no grain touches finally moves inwards
/// (length/time).
template <int Dim>
double ContactDynamics<Dim>::terminal_speed(const Wall<Dim>& wall) const {
  const double closing =
      load_.wall_speed.value_or(load_.strain_rate_cap * packing_.cell.matrix(wall.axis, wall.axis));
  return closing / n_moving_walls(packing_, wall.axis);
}

/// Adds the walls to the bodies of a step. The equation of motion of a wall is M dv/dt = F - P A - (P A/V) v, with the
/// mass M, the area A and the outward velocity v of the wall, the force F of the grains, the imposed pressure P and the
/// terminal speed V. The last term is a drag.
template <int Dim>
void ContactDynamics<Dim>::add_walls(double dt, bool at_rest, BodyMotion<Dim>& bodies) const {
  for (const Wall<Dim>& wall : packing_.walls) {
    double inverse = 0.0, velocity = wall.velocity;
    if (follows_forces(wall)) {
      const double force = load_.stress[wall.axis] * wall_area(packing_, wall.axis);
      const double drag = 1.0 + dt * force / (terminal_speed(wall) * wall.mass);
      inverse = 1.0 / (wall.mass * drag);
      velocity = (at_rest ? 0.0 : velocity) / drag - wall.side * dt * inverse * force;
    }
    bodies.velocity.push_back(velocity * Vec<Dim>::Unit(wall.axis));
    bodies.angular_velocity.push_back(RotationVector<Dim>::Zero());
    bodies.inverse_mass.push_back(inverse * Vec<Dim>::Unit(wall.axis));
    bodies.inverse_inertia.push_back(Mat<kRotations<Dim>>::Zero());
  }
}

/// Sets the rate of stretch of the cell in `bodies`. For a side under stress along axis a, the equation of motion of
/// the rate of stretch L is M_a dL/dt = V (sigma_a - P_a) - (V P_a/E) L, with the inertia M_a, the volume V, the stress
/// sigma_a of the contacts, the imposed stress P_a and the cap E on the strain rate. Without contacts, L tends to -E.
template <int Dim>
void ContactDynamics<Dim>::add_cell(double dt, bool at_rest, BodyMotion<Dim>& bodies) const {
  const double volume = packing_.cell.volume();
  const Mat<Dim> rate = packing_.cell.rate();
  for (int a = 0; a < Dim; ++a) {
    if (between_walls(packing_.walls, a)) continue;
    bodies.stretch[a] = rate(a, a);
    if (!load_.under_stress[a]) continue;
    const double side = packing_.cell.matrix(a, a);
    const double mass = load_.cell_mass * grain_mass_ * side * side;
    const double force = volume * load_.stress[a];
    const double drag = 1.0 + dt * force / (load_.strain_rate_cap * mass);
    bodies.stretch[a] = ((at_rest ? 0.0 : rate(a, a)) - dt * force / mass) / drag;
    bodies.inverse_stretch_mass[a] = 1.0 / (mass * drag);
  }
}

/// Returns the rate of change of the gap of a contact at the start of a step (length/time).
template <int Dim>
double ContactDynamics<Dim>::gap_rate(const Contact<Dim>& c) const {
  const Grains<Dim>& g = packing_.grains;
  Vec<Dim> u = -g.velocity[c.i] - cross<double>(g.angular_velocity[c.i], c.arm_i);
  if (packing_.is_wall(c.j))
    u[packing_.wall(c.j).axis] += packing_.wall(c.j).velocity;
  else
    u += g.velocity[c.j] + cross<double>(g.angular_velocity[c.j], c.arm_j) + cell_rate() * (c.arm_i - c.arm_j);
  return u.dot(c.normal);
}

/// Returns the coefficient of restitution of a contact for its present rate of approach.
template <int Dim>
double ContactDynamics<Dim>::restitution(const Contact<Dim>& c) const {
  return -gap_rate(c) > settings_.slow_impact ? settings_.restitution : 0.0;
}

/// Returns the time over which an overlap is removed: the time step, but not less than shortest_removal().
template <int Dim>
double ContactDynamics<Dim>::removal_time(double dt) const {
  return std::max(dt, shortest_removal(settings_));
}

/// Returns the contact points as contacts of a step, with the impulses of the last step as initial values. If impacts
/// are elastic, points with a gap are left out unless their adhesion acts. Otherwise the step would reduce the velocity
/// of approach so far that the gap only just closes. The velocity before the impact, from which the restitution is
/// computed, would be lost.
/// @param recorded  whether the packing contains the forces of this step, and not those of the step before: points
/// whose adhesion acted in the step then take part
template <int Dim>
std::vector<StepContact<Dim>> ContactDynamics<Dim>::step_contacts(double dt, double removed,
                                                                  std::vector<int>& source,
                                                                  bool recorded) const {
  Mat<Dim> shear = packing_.cell.rate();
  shear.diagonal().setZero();
  std::vector<StepContact<Dim>> out;
  for (std::size_t at = 0; at < packing_.contacts.size(); ++at) {
    const Contact<Dim>& c = packing_.contacts[at];
    const bool elastic_impact = settings_.restitution > 0.0;
    // The contact law alone does not give the adhesion in a recorded step, because adhesion across a gap acts only if a
    // force acted in the step before.
    const double recorded_adhesion = std::max(0.0, c.elastic_force - c.normal_force);
    const bool adhered = recorded && recorded_adhesion > 0.0;
    if (elastic_impact && c.gap > 0.0 && !sticks(c) && !adhered) continue;
    source.push_back(static_cast<int>(at));
    StepContact<Dim>& k = out.emplace_back();
    const Law& law = packing_.law_of(c);
    k.i = c.i;
    k.j = c.j;
    k.arm_i = c.arm_i;
    k.arm_j = c.arm_j;
    k.branch = packing_.is_wall(c.j) ? Vec<Dim>(Vec<Dim>::Zero()) : Vec<Dim>(c.arm_i - c.arm_j);
    k.frame = contact_frame(c.normal);
    k.friction = law.friction_coefficient();
    k.adhesion = dt * (recorded ? recorded_adhesion : sticks(c) ? law.pull_off_force() : 0.0);
    k.bias = k.frame.transpose() * (shear * k.branch);
    const bool rigid = law.is_rigid();
    const double removal = removal_time(dt);
    if (!rigid)
      add_springs(packing_, c, dt, k);
    else if (elastic_impact)
      k.bias[0] +=
          restitution(c) * std::min(0.0, gap_rate(c)) +
          kStabilisation * std::min(0.0, c.gap + kElasticOverlap * 2.0 * smaller_radius(packing_, c)) / removal;
    else
      k.bias[0] += c.gap > 0.0 ? c.gap / dt : removed * c.gap / removal;
    // If rigid grains collide in a short step, the recorded forces (impulse divided by time step) are large. Multiplied
    // by a longer step, these forces would give too large impulses. The forces are therefore multiplied by the shorter
    // of the last and the present time step.
    const double known = rigid ? std::min(dt, last_step_) : dt;
    k.impulse = -known * (k.frame.transpose() * c.shear_force);
    k.impulse[0] = known * c.elastic_force;
  }
  return out;
}

/// Returns, for each contact of a step, the matrix that gives the change of the momenta of its two grains due to the
/// rotation of its normal impulse (convex_stiffness()).
template <int Dim>
std::vector<PairMatrix<Dim>> ContactDynamics<Dim>::stiffnesses(const Trial& trial, double dt) const {
  std::vector<PairMatrix<Dim>> out;
  for (std::size_t k = 0; k < trial.contacts.size(); ++k) {
    if (trial.contacts[k].impulse[0] == 0.0) {
      out.push_back(PairMatrix<Dim>::Zero());
      continue;
    }
    const Contact<Dim>& c = packing_.contacts[static_cast<std::size_t>(trial.source[k])];
    out.push_back(convex_stiffness<Dim>(gap_curvature(packing_, c), dt * trial.contacts[k].impulse[0]));
  }
  return out;
}

/// Returns whether sweeps alone would adapt the stress too slowly to the motion of the cell. With N grains, the inertia
/// of the cell is about cell_mass N^(2/Dim) times that of a contact, and about so many sweeps are needed. As long as
/// the stress is wrong, even by a factor of two, the errors of the single impulses are below any tolerance.
template <int Dim>
bool ContactDynamics<Dim>::has_slow_cell() const {
  return std::ranges::count(load_.under_stress, true) > 0 &&
         load_.cell_mass * std::pow(packing_.grains.size(), 2.0 / Dim) > kSlowCell;
}

template <int Dim>
auto ContactDynamics<Dim>::solve(double dt, const Method& method) const -> Trial {
  Trial trial;
  trial.motion = free_motion(dt, method.at_rest);
  trial.contacts = step_contacts(dt, method.at_once ? method.removed : kStabilisation, trial.source);
  if (method.at_once && solve_at_once(trial.motion, trial.contacts, stiffnesses(trial, dt))) {
    trial.sweeps.converged = true;
    return trial;
  }
  if (has_slow_cell()) {
    const double factor = best_common_factor(trial.motion, trial.contacts);
    for (StepContact<Dim>& c : trial.contacts) c.impulse *= factor;
  }
  GaussSeidel<Dim> sweeps(trial.motion, trial.contacts, settings_.threads);
  trial.sweeps = sweeps.solve(settings_.sweep_tolerance, settings_.max_sweeps);
  return trial;
}

/// Returns the largest ratio of the displacement in a step to the allowed displacement, among all grains and walls.
template <int Dim>
double ContactDynamics<Dim>::largest_share_moved(const Trial& trial, double dt, const Method& method) const {
  const Grains<Dim>& g = packing_.grains;
  const bool has_many = g.size() > kManyGrains && !method.at_once;
  std::vector<double> allowed(trial.motion.size(), kLongestMove);
  if (!g.are_round() && !method.at_once && !has_many)
    for (const StepContact<Dim>& c : trial.contacts)
      if (c.impulse[0] > 0.0) allowed[c.i] = allowed[c.j] = kCarryingMove;
  std::vector<double> shares;
  for (int i = 0; i < g.size(); ++i) {
    const double speed =
        trial.motion.velocity[i].norm() + trial.motion.angular_velocity[i].norm() * g.radius[i];
    shares.push_back(speed * dt / (2.0 * g.radius[i] * allowed[i]));
  }
  const auto others = shares.begin() + (has_many ? g.size() / kGrainsPerFast : 0);
  std::ranges::nth_element(shares, others, std::greater<>());
  double largest = others == shares.end() ? 0.0 : *others;
  for (auto fast = shares.begin(); fast != others; ++fast) largest = std::max(largest, *fast / kFurther);
  const double a = largest_diameter(g);
  for (std::size_t w = 0; w < packing_.walls.size(); ++w) {
    const std::size_t body = static_cast<std::size_t>(g.size()) + w;
    largest = std::max(largest, trial.motion.velocity[body].norm() * dt / (a * kLongestMove));
  }
  return largest;
}

/// Returns the packing at the end of a step. Its contacts are the contacts at the start of the step, with the forces of
/// the step.
template <int Dim>
Packing<Dim> ContactDynamics<Dim>::moved(const Trial& trial, double dt) const {
  Packing<Dim> out = packing_;
  Mat<Dim> rate = cell_rate();
  for (int a = 0; a < Dim; ++a)
    if (!between_walls(out.walls, a)) rate(a, a) = trial.motion.stretch[a];
  Grains<Dim>& g = out.grains;
  g.position_low.clear();
  for (int i = 0; i < g.size(); ++i) {
    g.velocity[i] = trial.motion.velocity[i];
    g.angular_velocity[i] = trial.motion.angular_velocity[i];
    g.position[i] += dt * (rate * g.position[i] + g.velocity[i]);
    g.orientation[i] = turned(g.orientation[i], RotationVector<Dim>(dt * g.angular_velocity[i]));
  }
  out.cell.matrix += dt * out.cell.matrix * rate.transpose();
  out.cell.velocity = out.cell.matrix * rate.transpose();
  for (std::size_t w = 0; w < out.walls.size(); ++w) {
    Wall<Dim>& wall = out.walls[w];
    wall.velocity = trial.motion.velocity[static_cast<std::size_t>(g.size()) + w][wall.axis];
    wall.position += dt * wall.velocity;
    out.cell.matrix(wall.axis, wall.axis) += wall.side * dt * wall.velocity;
    out.cell.velocity(wall.axis, wall.axis) += wall.side * wall.velocity;
  }
  set_forces(trial, dt, out);
  // The tangential forces of springs turn with the two bodies.
  const std::vector<RotationVector<Dim>>& spin = trial.motion.angular_velocity;
  if (!out.law.is_rigid())
    for (Contact<Dim>& c : out.contacts)
      c.shear_force = rotated(c.shear_force, RotationVector<Dim>(0.5 * dt * (spin[c.i] + spin[c.j])));
  return out;
}

/// Sets the forces of the contacts of a packing to those of a step.
template <int Dim>
void ContactDynamics<Dim>::set_forces(const Trial& trial, double dt, Packing<Dim>& packing) const {
  for (Contact<Dim>& c : packing.contacts) c.normal_force = c.elastic_force = 0.0, c.shear_force.setZero();
  for (std::size_t k = 0; k < trial.contacts.size(); ++k) {
    const StepContact<Dim>& from = trial.contacts[k];
    Contact<Dim>& c = packing.contacts[static_cast<std::size_t>(trial.source[k])];
    c.elastic_force = from.impulse[0] / dt;
    c.normal_force = (from.impulse[0] - from.adhesion) / dt;
    c.shear_force = -(from.frame * from.impulse - from.impulse[0] * c.normal) / dt;
    c.sliding = mobilised(packing.law_of(c), c, kAtLimit).sliding;
  }
}

template <int Dim>
SweepResult ContactDynamics<Dim>::find_forces() {
  const Method swept{.at_rest = false, .at_once = false};
  while (true) {
    const Trial trial = solve(time_step_, swept);
    if (largest_share_moved(trial, time_step_, swept) > 1.0) {
      time_step_ *= 0.5;
      continue;
    }
    set_forces(trial, time_step_, packing_);
    last_step_ = time_step_;
    return trial.sweeps;
  }
}

template <int Dim>
double ContactDynamics<Dim>::error_of_forces() const {
  BodyMotion<Dim> motion = free_motion(time_step_, false);
  std::vector<int> source;
  std::vector<StepContact<Dim>> contacts = step_contacts(time_step_, kStabilisation, source, true);
  return GaussSeidel<Dim>(motion, contacts).residual();
}

/// Returns the deepest overlap of the contacts, divided by the diameter of the smaller grain, and sets `where` to the
/// contact with this overlap.
template <int Dim>
double ContactDynamics<Dim>::deepest_overlap(const Packing<Dim>& packing, const Contact<Dim>*& where) const {
  double deepest = 0.0;
  for (const Contact<Dim>& c : packing.contacts) {
    const double smaller = smaller_radius(packing, c);
    if (-c.gap / (2.0 * smaller) > deepest) deepest = -c.gap / (2.0 * smaller), where = &c;
  }
  return deepest;
}

template <int Dim>
void ContactDynamics<Dim>::step(bool at_rest) {
  const Contact<Dim>* where = nullptr;
  double allowed =
      std::max(packing_.law.is_rigid() ? kDeepest : kDeepestElastic, deepest_overlap(packing_, where));
  Method method{at_rest, settings_.at_once};
  double dt = time_step_;
  bool rescues = false;
  for (int halvings = 0;;) {
    const Trial trial = solve(dt, method);
    const double share = largest_share_moved(trial, dt, method);
    if (share > 1.0) {
      dt *= 0.5;
      // A shorter step does not reduce the displacements that remove overlaps. The share of each overlap that is
      // removed is therefore halved, too.
      if (method.at_once) method.removed *= 0.5;
      continue;
    }
    Packing<Dim> next = moved(trial, dt);
    find_contacts(next);
    const double deepest = deepest_overlap(next, where);
    if (deepest > allowed) {
      dt *= 0.5;
      if (++halvings <= kMostHalvings && dt > kShortestStep * settings_.longest_step) continue;
      if (rescues)
        throw NoResult(
            fmt::format("{} would overlap by {:.2g} of the smaller diameter in a time step, even after "
                        "the step was halved {} times; the largest overlap allowed is {:.2g}",
                        pair_name(next, *where), deepest, kMostHalvings, allowed));
      // Sweeps leave errors in the impulses, which may cause overlaps that shorter steps do not remove. The step is
      // therefore solved at once and from rest.
      rescues = true;
      method = {.at_rest = true, .at_once = true};
      allowed = std::max(allowed, kDeepestAtRest);
      dt = settings_.longest_step;
      halvings = 0;
      continue;
    }
    if (method.at_once && (method.at_rest || turns_back(packing_, next))) stop_all(next);
    packing_ = std::move(next);
    last_step_ = dt;
    time_step_ = share < kTimid && halvings == 0 ? std::min(2.0 * dt, settings_.longest_step) : dt;
    ++counts_.n_steps;
    counts_.n_sweeps += trial.sweeps.n_sweeps;
    counts_.n_unfinished += !trial.sweeps.converged;
    counts_.deepest_overlap = std::max(counts_.deepest_overlap, deepest);
    return;
  }
}

template class ContactDynamics<2>;
template class ContactDynamics<3>;

}  // namespace floc
