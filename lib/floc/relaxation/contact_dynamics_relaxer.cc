#include "floc/relaxation/contact_dynamics_relaxer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floc/base/error.h"
#include "floc/packing/balance.h"
#include "floc/packing/grain_sizes.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/packing/wall_forces.h"
#include "floc/packing/wrap.h"
#include "floc/relaxation/members_as_json.h"
#include "floc/relaxation/relaxer.h"
#include "floc/rigid/static_forces.h"

namespace floc {
namespace {

/// Number of time steps in one call of advance().
constexpr int kSteps = 20;
/// Number of successive calm steps after which the motion counts as ended. In a calm step, the root mean square
/// velocity is below kCalmVelocity d/T, with the largest diameter d and the time unit T, and the strain rate of the
/// cell is below kCalmRate times its cap. The relative error of the stress is then below kCalmRate, too.
constexpr int kCalmSteps = 40;
constexpr double kCalmRate = 0.03;
constexpr double kCalmVelocity = 6e-3;
/// Factor by which kCalmRate and kCalmVelocity are larger for frictionless polyhedra, whose motion decays slowly
/// because their corners alternate in contact.
constexpr double kJitter = 4.0;
/// Impacts are inelastic if the rate of approach, in units of a dt/T^2, is below this number. Here a is the largest
/// diameter, dt the time step and T the time unit. The unit a dt/T^2 is the velocity that the pressure gives to a grain
/// in one time step.
constexpr double kSlowImpact = 2.0;
/// Factor by which the tolerance of the sweeps is larger while the packing counts as a gas.
constexpr double kGasTolerance = 10.0;
/// A packing counts as a gas if its mean stress, divided by the mean imposed stress, is below this number.
constexpr double kGasStress = 0.3;
/// Longest and shortest time step of the phase `resting`, in units of T.
constexpr double kLongestRest = 0.5;
constexpr double kShortestRest = 1e-3;
/// Largest number of sweeps in a time step of the phase `resting`: at the beginning of the phase (kRestingSweeps), and
/// after all increases (kMostRestingSweeps).
constexpr int kRestingSweeps = 300;
constexpr int kMostRestingSweeps = 9600;
/// Number of steps of the phase `resting` after which the contacts of a step are solved all at once instead of by
/// sweeps.
constexpr int kSweptSteps = 2600;
/// Largest number of grains for which contacts are solved all at once; grains with corners and without friction have no
/// such limit.
constexpr int kMostGrainsAtOnce = 1000;
/// Longest time step, in units of T, if contacts are solved all at once: without separating plates, and with separating
/// plates (separating_plates.h).
constexpr double kLongestAtOnce = 3.0;
constexpr double kLongestWithPlates = 30.0;
/// Longest time step of elastic grains that is solved all at once, in units of T.
constexpr double kLongestOnSprings = 30.0;
/// Smallest mean stress of elastic grains at rest, divided by the mean imposed stress, at which the relaxation begins with
/// the phase `resting`.
constexpr double kLoadedStress = 0.3;
/// Largest gap, divided by the diameter of the smaller grain, at which a contact may have a force if contacts are
/// solved all at once.
constexpr double kGapAtOnce = 1e-6;
/// Tolerance of the impulses in the phase `resting`, divided by the mean normal impulse: the sweeps of a step end when
/// the error is below this tolerance.
constexpr double kRestingTolerance = 1e-8;
/// The forces count as nearly balanced if the largest net force on a grain, divided by the mean repulsive force, is
/// below this number: for round grains, and for grains with corners.
constexpr double kNearBalanceRound = 1e-3;
constexpr double kNearBalanceAngular = 3e-2;
/// Number of steps of the phase `resting` between two searches for balanced forces. If the net forces are large, the
/// next search begins only after twice this number of steps.
constexpr int kStepsBetweenTrials = 50;
/// Number of steps of the phase `resting` after which the relaxation is given up.
constexpr int kMostRestingSteps = 3000;
/// Default values of ContactDynamicsOptions::gap_tolerance: for round grains, and for grains with corners.
constexpr double kGapToleranceRound = 1e-4;
constexpr double kGapToleranceAngular = 1e-3;
/// Number of steps of the test whether a packing with balanced forces is stable: in these steps the packing moves
/// freely.
constexpr int kFreeSteps = 50;
/// Largest displacement of a grain in the test of stability (kFreeSteps), divided by the product of the diameter of the
/// grain and the gap tolerance.
constexpr double kStaysWithin = 10.0;
/// A contact counts as force-free if its force, divided by the mean repulsive force, is at most this number.
constexpr double kCarries = 1e-9;
/// A contact counts as sliding if the difference between its tangential force and the Coulomb limit, divided by the
/// limit, is at most this number.
constexpr double kAtLimit = 1e-9;

/// Function that calls visit(name, member) for every member of a ContactDynamicsProgress, with the name that the member
/// has in checkpoints.
constexpr auto kMembers = [](auto& p, const auto& visit) {
  visit("phase", p.phase);
  visit("n_steps", p.n_steps);
  visit("n_sweeps", p.n_sweeps);
  visit("n_unfinished", p.n_unfinished);
  visit("time", p.time);
  visit("time_step", p.time_step);
  visit("last_step", p.last_step);
  visit("deepest_overlap", p.deepest_overlap);
  visit("calm_steps", p.calm_steps);
  visit("resting_steps", p.resting_steps);
  visit("least_residual", p.least_residual);
  visit("least_at", p.least_at);
  visit("next_trial", p.next_trial);
  visit("rest_length", p.rest_length);
  visit("rest_sweeps", p.rest_sweeps);
  visit("side_before", p.side_before);
  visit("offset_before", p.offset_before);
  visit("obstacle", p.obstacle);
};

void start_resting(ContactDynamicsProgress& progress) {
  progress.phase = ContactDynamicsProgress::resting;
  progress.rest_length = kLongestRest;
  progress.rest_sweeps = kRestingSweeps;
  progress.time_step = 0.0;
}

template <int Dim>
bool is_at_rest(const Packing<Dim>& packing) {
  return packing.cell.velocity.isZero(0.0) &&
         std::ranges::all_of(packing.grains.velocity, [](const Vec<Dim>& v) { return v.isZero(0.0); });
}

/// Returns the root mean square velocity of the grains. The mean is weighted with the masses, since light grains may
/// fly about in voids for a long time.
template <int Dim>
double rms_velocity(const Grains<Dim>& grains) {
  double sum = 0.0, mass = 0.0;
  for (int i = 0; i < grains.size(); ++i) {
    sum += grains.mass[i] * grains.velocity[i].squaredNorm();
    mass += grains.mass[i];
  }
  return std::sqrt(sum / mass);
}

/// Returns whether grains are polyhedra without friction and adhesion.
template <int Dim>
bool are_smooth_polyhedra(const Packing<Dim>& packing) {
  const auto has_faces = [](const auto& shape) { return shape.n_faces() > 0; };
  return Dim == 3 && packing.law.friction_coefficient() == 0.0 && packing.law.pull_off_force() == 0.0 &&
         !packing.grains.are_round() && std::ranges::any_of(*packing.grains.shapes, has_faces);
}

template <int Dim>
void stop(Packing<Dim>& packing) {
  stop_grains(packing);
  for (Wall<Dim>& wall : packing.walls) wall.velocity = 0.0;
}

/// Returns the stress on each axis from which the scales of time and force follow: the imposed stress or, on an axis
/// with an imposed length, the mean of the imposed stresses. The stress in the packing does not serve as a scale, since
/// it fluctuates during motion.
/// @throws InputError if no stress is imposed, or an imposed stress is not positive
template <int Dim>
Vec<Dim> imposed_stress(const LoadTarget<Dim>& load) {
  double sum = 0.0;
  int n = 0;
  for (int a = 0; a < Dim; ++a) {
    if (load.strained(a)) continue;
    if (!(load.stress[a] > 0.0))
      throw InputError("load",
                       "rigid grains need a positive stress on every axis without an imposed length, because "
                       "this stress sets the scale of forces");
    sum += load.stress[a], ++n;
  }
  if (n == 0)
    throw InputError(
        "load",
        "the lengths of all axes are imposed, but rigid grains need a stress on at least one axis, because "
        "this stress sets the scale of forces");
  Vec<Dim> out = load.stress;
  for (int a = 0; a < Dim; ++a)
    if (load.strained(a)) out[a] = sum / n;
  return out;
}

/// Subtracts the adhesion of the contact law from the normal forces of all contacts, and removes contacts that have a
/// gap and have not adhered, since they carry no force.
template <int Dim>
void hold_adhesion(Packing<Dim>& packing) {
  std::erase_if(packing.contacts, [&](const Contact<Dim>& c) {
    return packing.law_of(c).pull_off_force() > 0.0 && c.gap > 0.0 && c.elastic_force == 0.0;
  });
  for (Contact<Dim>& c : packing.contacts)
    c.normal_force = c.elastic_force - packing.law_of(c).pull_off_force();
}

}  // namespace

template <int Dim>
ContactDynamicsRelaxer<Dim>::ContactDynamicsRelaxer(const RelaxationOptions& options, Packing<Dim> packing,
                                                    const LoadTarget<Dim>& load, const std::string& progress)
    : options_(options),
      packing_(std::move(packing)),
      load_(load),
      imposed_(imposed_stress(load)),
      target_(imposed_) {
  if (!progress.empty())
    progress_ =
        members_from_json<ContactDynamicsProgress>(progress, "progress",
                                                   "the text does not contain the progress of a relaxation of "
                                                   "rigid grains in the format of this version of floc",
                                                   kMembers);
  time_unit_ = inertial_time(packing_, imposed_);
  if (progress.empty()) begin_strain();
  measure();
  // Motion, with the errors of its sweeps, would slip contacts that the load does not slip.
  if (progress.empty() && is_elastic() && is_at_rest(packing_) &&
      stress_.trace() > kLoadedStress * imposed_.sum())
    start_resting(progress_);
}

/// Returns whether the contacts of a step of the phase `resting` are solved all at once. For elastic grains and for
/// frictionless grains with corners this holds from the start. For other packings it holds after kSweptSteps steps with
/// sweeps, if there are at most kMostGrainsAtOnce grains.
template <int Dim>
bool ContactDynamicsRelaxer<Dim>::solves_at_once() const {
  if (progress_.phase != ContactDynamicsProgress::resting) return false;
  if (is_elastic()) return true;
  const Grains<Dim>& grains = packing_.grains;
  const bool frictionless = packing_.law.friction_coefficient() == 0.0;
  return (frictionless && !grains.are_round()) ||
         (progress_.resting_steps >= kSweptSteps && grains.size() <= kMostGrainsAtOnce);
}

/// Returns whether steps are solved with separating plates between the grains (separating_plates.h).
template <int Dim>
bool ContactDynamicsRelaxer<Dim>::has_plates() const {
  return solves_at_once() && are_smooth_polyhedra(packing_);
}

template <int Dim>
ContactDynamicsSettings ContactDynamicsRelaxer<Dim>::settings() const {
  const ContactDynamicsOptions& own = options_.contact_dynamics;
  const bool resting = progress_.phase == ContactDynamicsProgress::resting;
  const bool is_gas = stress_.trace() < kGasStress * imposed_.sum();
  const bool plates = has_plates();
  const double longest = !resting           ? own.time_step
                         : is_elastic()     ? kLongestOnSprings
                         : plates           ? kLongestWithPlates
                         : solves_at_once() ? kLongestAtOnce
                                            : progress_.rest_length;
  return {.longest_step = longest * time_unit_,
          .sweep_tolerance = resting ? std::min(kRestingTolerance, own.sweep_tolerance)
                                     : (is_gas ? kGasTolerance : 1.0) * own.sweep_tolerance,
          .max_sweeps = resting ? progress_.rest_sweeps : own.max_sweeps,
          .restitution = resting ? 0.0 : own.restitution,
          .slow_impact = kSlowImpact * own.time_step * largest_diameter(packing_.grains) / time_unit_,
          .threads = options_.threads,
          .at_once = solves_at_once(),
          .plates = plates};
}

template <int Dim>
BoundaryLoad<Dim> ContactDynamicsRelaxer<Dim>::boundary_load() const {
  BoundaryLoad<Dim> load;
  load.stress = imposed_;
  // In a box, periodic axes keep their lengths.
  for (int a = 0; a < Dim; ++a) load.under_stress[a] = packing_.walls.empty() && !load_.strained(a);
  load.cell_mass = options_.cell_mass;
  // A cap on the rate makes the walls heavier than all grains together, so that sweeps converge slowly. In the phase
  // `resting` the cap is not needed.
  if (!packing_.walls.empty() && progress_.phase == ContactDynamicsProgress::resting) return load;
  load.wall_speed = options_.compaction.wall_speed;
  // A strained cell has no cap on its strain rate: the drag that limits the strain rate would balance a part of the
  // stress on sides that grow.
  if (progress_.phase != ContactDynamicsProgress::straining)
    load.strain_rate_cap = strain_rate_cap(options_, packing_, imposed_);
  return load;
}

template <int Dim>
double ContactDynamicsRelaxer<Dim>::gap_tolerance() const {
  return options_.contact_dynamics.gap_tolerance.value_or(packing_.grains.are_round() ? kGapToleranceRound
                                                                                      : kGapToleranceAngular);
}

/// Returns the largest relative rate |L'/L| of a side of the cell, or of the distance between two walls (1/time).
template <int Dim>
double ContactDynamicsRelaxer<Dim>::boundary_rate(const Packing<Dim>& packing) const {
  return packing.cell.rate().diagonal().cwiseAbs().maxCoeff();
}

/// Returns the rate at which the boundary would close without contacts, but at most 1/T (1/time).
template <int Dim>
double ContactDynamicsRelaxer<Dim>::rate_cap(const Packing<Dim>& packing) const {
  double cap = strain_rate_cap(options_, packing, imposed_);
  if (const std::optional<double>& speed = options_.compaction.wall_speed; speed && !packing.walls.empty())
    cap = *speed / packing.cell.matrix.diagonal().maxCoeff();
  return std::min(cap, 1.0 / time_unit_);
}

/// Returns whether the motion of the packing has nearly ended. Whether the stress is balanced is judged from the strain
/// rate of the cell. This rate is proportional to the difference between the stress and the imposed stress, and the
/// errors of single impulses cancel in the strain rate.
template <int Dim>
bool ContactDynamicsRelaxer<Dim>::is_calm(const Packing<Dim>& packing) const {
  const double jitter = are_smooth_polyhedra(packing) ? kJitter : 1.0;
  const double velocity = jitter * kCalmVelocity * largest_diameter(packing.grains) / time_unit_;
  return rms_velocity(packing.grains) < velocity &&
         boundary_rate(packing) < jitter * kCalmRate * rate_cap(packing);
}

/// Makes time steps and then moves the grains into the cell, so that an interrupted relaxation continues from identical
/// positions.
template <int Dim>
void ContactDynamicsRelaxer<Dim>::make_steps(int n_steps) {
  const ContactDynamicsSettings chosen = settings();
  const double first =
      progress_.time_step > 0.0 ? std::min(progress_.time_step, chosen.longest_step) : chosen.longest_step;
  const bool at_rest = progress_.phase == ContactDynamicsProgress::resting;
  const bool stops = at_rest && (!chosen.at_once || chosen.plates || is_elastic());
  ContactDynamics<Dim> motion(std::move(packing_), boundary_load(), chosen, first, progress_.last_step);
  for (int k = 0; k < n_steps; ++k) {
    if (progress_.phase == ContactDynamicsProgress::straining && !impose_strain(motion)) break;
    motion.step(stops);
    // Steps of the phase `resting` do not count as simulated time.
    if (!at_rest) progress_.time += motion.last_step();
    progress_.calm_steps = is_calm(motion.packing()) ? progress_.calm_steps + 1 : 0;
    if (observer_.callback && k + 1 < n_steps) observer_.callback(motion.packing(), progress_.time);
  }
  progress_.n_steps += motion.counts().n_steps;
  progress_.n_sweeps += motion.counts().n_sweeps;
  // The small number of sweeps in a step of the phase `resting` is intended, since the next step starts from the
  // impulses of this step. Steps of the phase `resting` therefore do not count as unfinished.
  if (!at_rest) progress_.n_unfinished += motion.counts().n_unfinished;
  progress_.deepest_overlap = std::max(progress_.deepest_overlap, motion.counts().deepest_overlap);
  progress_.time_step = motion.time_step();
  progress_.last_step = motion.last_step();
  packing_ = motion.release_packing();
  wrap_into_cell(packing_);
  fit_open_ends(packing_);
  measure();
  if (observer_.callback) observer_.callback(packing_, progress_.time);
}

template <int Dim>
RelaxationStatus ContactDynamicsRelaxer<Dim>::advance() {
  if (progress_.phase == ContactDynamicsProgress::resting) return is_elastic() ? rest_on_springs() : rest();
  if (progress_.phase == ContactDynamicsProgress::straining) return strain();
  make_steps(kSteps);
  if (progress_.calm_steps >= kCalmSteps) start_resting(progress_);
  return progress_.time > options_.max_time * time_unit_ ? RelaxationStatus::gave_up
                                                         : RelaxationStatus::running;
}

/// Makes steps of the phase `resting`, then seeks balanced forces if the net forces are small or if the last search was
/// many steps ago.
template <int Dim>
RelaxationStatus ContactDynamicsRelaxer<Dim>::rest() {
  make_steps(kSteps);
  progress_.resting_steps += kSteps;
  const bool tries =
      progress_.resting_steps >= progress_.next_trial &&
      (forces_are_nearly_balanced() || progress_.resting_steps >= progress_.next_trial + kStepsBetweenTrials);
  if (tries) {
    if (find_balanced_forces()) return RelaxationStatus::converged;
    progress_.next_trial = progress_.resting_steps + kStepsBetweenTrials;
  }
  return progress_.resting_steps >= kMostRestingSteps ? RelaxationStatus::gave_up : RelaxationStatus::running;
}

template <int Dim>
bool ContactDynamicsRelaxer<Dim>::forces_are_nearly_balanced() const {
  double largest = 0.0;
  for (const Vec<Dim>& force : net_forces(packing_).force) largest = std::max(largest, force.norm());
  return largest < near_balance() * mean_repulsive_force(packing_);
}

template <int Dim>
double ContactDynamicsRelaxer<Dim>::near_balance() const {
  return packing_.grains.are_round() ? kNearBalanceRound : kNearBalanceAngular;
}

/// Returns the largest gap or overlap of the contacts, divided by the diameter of the smaller grain. A gap counts only
/// if the contact carries a force that exceeds the errors of the balance.
template <int Dim>
double ContactDynamicsRelaxer<Dim>::largest_gap() const {
  const double least = near_balance() * mean_repulsive_force(packing_);
  double largest = 0.0;
  for (const Contact<Dim>& c : packing_.contacts)
    largest = std::max(
        largest, (c.elastic_force > least ? std::abs(c.gap) : -c.gap) / (2.0 * smaller_radius(packing_, c)));
  return largest;
}

/// Replaces the forces of the last step by forces that balance all grains exactly. Returns false if there are no such
/// forces.
template <int Dim>
bool ContactDynamicsRelaxer<Dim>::find_balanced_forces() {
  const double tolerance = gap_tolerance();
  const double reached_gap = solves_at_once() ? std::min(tolerance, kGapAtOnce) : tolerance;
  if (const double gap = largest_gap(); gap > reached_gap) {
    progress_.obstacle = fmt::format(
        "the largest gap of a contact with a force, or the largest overlap, is {:.2g} times the diameter of "
        "the smaller grain, but the tolerance is {:.2g}",
        gap, reached_gap);
    // Errors of the impulses displace grains in proportion to the square of the time step, so the longest step is
    // halved.
    if (!solves_at_once()) progress_.rest_length = std::max(0.5 * progress_.rest_length, kShortestRest);
    return false;
  }
  Packing<Dim> rested = packing_;
  stop(rested);
  rested.contacts = ContactPoints<Dim>().find_touching(rested, tolerance);
  carry_forces(rested, packing_.contacts, rested.contacts);
  hold_adhesion(rested);
  try {
    if (options_.contact_dynamics.forces != RigidForces::stepped) set_balanced_forces(rested);
  } catch (const NoResult& reason) {
    progress_.obstacle = reason.what();
    // A grain still moves, so the longest step is doubled. The number of sweeps is doubled, too: without friction, many
    // sweeps are needed to resolve a slow motion.
    progress_.rest_length = std::min(2.0 * progress_.rest_length, kLongestRest);
    progress_.rest_sweeps = std::min(2 * progress_.rest_sweeps, kMostRestingSweeps);
    return false;
  }
  const Mat<Dim> stress = static_stress(rested);
  const Residuals reached = residuals(rested, load_.stress_with(stress), stress);
  if (!reached.within(options_.tolerance)) {
    progress_.obstacle = worst_residual(reached, options_.tolerance, rested.grains.id);
    return false;
  }
  if (!stays_in_place(rested)) {
    progress_.obstacle =
        "the equilibrium is unstable: grains leave their places when the packing is free to move";
    progress_.phase = ContactDynamicsProgress::moving;
    progress_.calm_steps = 0;
    progress_.time_step = 0.0;
    return false;
  }
  packing_ = std::move(rested);
  stress_ = stress;
  target_ = load_.stress_with(stress);
  residuals_ = reached;
  const std::string names[] = {"closest", "canonical", "stepped"};
  ending_ = names[static_cast<int>(options_.contact_dynamics.forces)];
  return true;
}

/// Returns whether the grains with contacts stay in place when the packing is free to move for some steps. The test
/// finds packings whose forces are balanced, but whose equilibrium is unstable.
template <int Dim>
bool ContactDynamicsRelaxer<Dim>::stays_in_place(const Packing<Dim>& rested) const {
  std::vector<bool> carries(rested.grains.size(), false);
  for (const Contact<Dim>& c : rested.contacts) {
    carries[c.i] = true;
    if (!rested.is_wall(c.j)) carries[c.j] = true;
  }
  ContactDynamicsSettings chosen = settings();
  chosen.longest_step = options_.contact_dynamics.time_step * time_unit_;
  if (is_elastic()) chosen.at_once = false;
  ContactDynamics<Dim> motion(rested, boundary_load(), chosen, chosen.longest_step);
  for (int k = 0; k < kFreeSteps; ++k) motion.step(false);
  // A drift of the walls together with all grains between them is allowed.
  const Packing<Dim> before = with_walls_at_cell(rested), now = with_walls_at_cell(motion.packing());
  const double allowed = kStaysWithin * gap_tolerance();
  for (int i = 0; i < rested.grains.size(); ++i) {
    const Vec<Dim> carried_along = now.cell.matrix.transpose() * before.cell.reduced(before.grains.position[i]);
    const double moved = (now.grains.position[i] - carried_along).norm();
    if (carries[i] && moved > allowed * 2.0 * rested.grains.radius[i]) return false;
  }
  return true;
}

/// Replaces the forces of a packing at rest by forces that balance all grains and the load, and removes contacts that
/// then carry no force.
/// @throws NoResult if no forces balance the grains and the load
template <int Dim>
void ContactDynamicsRelaxer<Dim>::set_balanced_forces(Packing<Dim>& packing) const {
  ForceBalanceOptions<Dim> options;
  if (packing.walls.empty()) {
    options.axis_stress = imposed_;
    for (int a = 0; a < Dim; ++a) options.open_axis[a] = load_.strained(a);
  } else {
    std::vector<double> load;
    for (const Wall<Dim>& wall : packing.walls)
      load.push_back(imposed_[wall.axis] * wall_area(packing, wall.axis));
    options.wall_force = forces_on_moving_walls(packing, load);
  }
  StaticForces<Dim> forces("the packing", packing, options);
  const bool closest = options_.contact_dynamics.forces == RigidForces::closest;
  const BalancedForces<Dim> found = closest ? forces.closest() : forces.canonical();
  for (std::size_t k = 0; k < packing.contacts.size(); ++k) {
    Contact<Dim>& c = packing.contacts[k];
    const double adhesion = std::max(0.0, c.elastic_force - c.normal_force);
    c.normal_force = found.normal_force[k];
    c.elastic_force = c.normal_force + adhesion;
    c.shear_force = found.shear_force[k];
    c.sliding = mobilised(packing.law_of(c), c, kAtLimit).sliding;
  }
  const double least = kCarries * mean_repulsive_force(packing);
  std::erase_if(packing.contacts, [&](const Contact<Dim>& c) { return !(c.elastic_force > least); });
}

template <int Dim>
void ContactDynamicsRelaxer<Dim>::measure() {
  stress_ = static_stress(packing_);
  target_ = load_.stress_with(stress_);
  residuals_ = residuals(packing_, target_, stress_);
}

template <int Dim>
RelaxationReport ContactDynamicsRelaxer<Dim>::report() const {
  RelaxationReport report;
  report.residuals = residuals_;
  report.stability = stability_;
  report.ending = ending_;
  report.motion = motion_;
  const bool resting = progress_.phase == ContactDynamicsProgress::resting;
  report.phase = resting ? "finishing" : "moving";
  report.time = progress_.time;
  report.n_steps = progress_.n_steps;
  report.counts = {progress_.n_steps, progress_.n_sweeps, progress_.n_unfinished, progress_.deepest_overlap};
  if (ending_ == "closed") report.blocking = closed_cell();
  if (!ending_.empty()) return report;
  if (progress_.phase == ContactDynamicsProgress::straining)
    report.blocking = "the imposed strain is not reached yet";
  else if (resting)
    report.blocking =
        progress_.obstacle.empty() ? "the net forces on the grains are not small yet" : progress_.obstacle;
  else
    report.blocking = fmt::format(
        "the grains still move: their root mean square velocity is {:.2g} of the largest diameter per time "
        "unit T, and the largest strain rate of the {} is {:.2g} per T",
        rms_velocity(packing_.grains) * time_unit_ / largest_diameter(packing_.grains),
        packing_.walls.empty() ? "cell" : "box", boundary_rate(packing_) * time_unit_);
  return report;
}

template <int Dim>
std::string ContactDynamicsRelaxer<Dim>::progress() const {
  return members_as_json(progress_, kMembers);
}

template class ContactDynamicsRelaxer<2>;
template class ContactDynamicsRelaxer<3>;

}  // namespace floc
