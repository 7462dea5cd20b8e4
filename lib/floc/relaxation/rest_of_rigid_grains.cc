// Member functions of class ContactDynamicsRelaxer for rigid grains that come to rest.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floc/base/error.h"
#include "floc/base/interruption.h"
#include "floc/packing/balance.h"
#include "floc/packing/grain_sizes.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/packing/locate.h"
#include "floc/packing/wall_forces.h"
#include "floc/packing/wrap.h"
#include "floc/relaxation/contact_dynamics_relaxer.h"
#include "floc/rigid/contact_dynamics.h"
#include "floc/rigid/contact_points.h"
#include "floc/rigid/least_volume.h"
#include "floc/rigid/static_forces.h"

namespace floc {
namespace {

/// Longest time step at the beginning of the phase `resting`, and shortest limit to which it is reduced, in units of T.
/// Errors of the impulses displace grains in proportion to the square of the time step. In a test, a step of 0.5 T made
/// disks overlap by 30 times the gap tolerance.
constexpr double kLongestRest = 0.125;
constexpr double kShortestRest = 1e-3;
/// Value of kLongestRest for more than kManyGrains grains with corners. The sweeps of a step leave the larger errors
/// the more grains there are: 20 000 polyhedra overlapped by 35 times the tolerance after steps of 0.125 T, and three
/// halvings of the step, with 100 steps each, took seven minutes.
constexpr double kLongestRestOfMany = 1.0 / 64.0;
/// After a failed search for balanced forces, the grains move until kCalmSteps plus this number of steps have been
/// calm. The motion away from an unstable equilibrium grows from rest, so that its first steps are calm, too.
constexpr int kMoreCalmSteps = 160;
/// Longest time step of elastic grains in the phase `resting`, in units of T. Each step is solved all at once.
constexpr double kLongestOnSprings = 30.0;
/// Largest gap, divided by the diameter of the smaller grain, at which a contact without friction may have a force if
/// contacts are solved all at once.
constexpr double kGapAtOnce = 1e-6;
/// Deepest overlap of grains with corners, divided by the gap tolerance, at which balanced forces are sought. Steps
/// remove overlaps, and this moves grains with corners by many times the overlap, as if the equilibrium were unstable.
/// In a test with 5000 polyhedra, 22 left their places with 1.0 in place of 0.1, and 4 with 0.1.
constexpr double kOverlapWithCorners = 0.1;
/// The forces count as nearly balanced if the largest net force on a grain, divided by the mean repulsive force, is
/// below kNearBalanceRound (round grains) or kNearBalanceAngular (grains with corners).
constexpr double kNearBalanceRound = 1e-3;
constexpr double kNearBalanceAngular = 3e-2;
/// Balanced forces of grains with corners avoid contacts with a gap of more than about this size, divided by the
/// diameter of the smaller grain (StaticForces::closest()). This does not apply to polyhedra without friction, which
/// rest at a minimum of the volume, where the forces are unique. The gap tolerance is larger, because without any
/// forces across larger gaps there is often no balance. In a packing of 5000 polyhedra, 85 contacts with a gap above
/// 1e-5 had a force; if gaps were not avoided, there were 3000.
constexpr double kCostlyGap = 1e-5;
/// Number of steps of the phase `resting` between two searches for balanced forces. If the net forces are large, the
/// next search begins only after twice this number of steps.
constexpr int kStepsBetweenTrials = 50;
/// Number of times that rounded polyhedra near a minimum of the volume make steps, with a search for balanced forces
/// after each time.
constexpr int kTrialsNearMinimum = 10;
/// Number of steps of the phase `resting` after which the relaxation is given up.
constexpr int kMostRestingSteps = 3000;
/// To test whether a packing with balanced forces is stable, it moves freely for this number of steps. If grains have
/// left their places by then, it moves for the same number of steps again.
constexpr int kFreeSteps = 50;
/// Largest number of sweeps in a step of this test for rigid grains. Steps whose sweeps end early displace grains as if
/// the equilibrium were unstable: with 300 to 400 sweeps, 9 to 14 of 5000 polyhedra left their places in an equilibrium
/// in which none did with 4000.
constexpr int kFreeSweeps = 4000;
/// Displacement up to which a grain counts as in place in the test of stability, divided by the product of the diameter
/// of the grain and the gap tolerance. Contacts may have a gap of the size of the tolerance, and while these gaps
/// close, grains move and turn by a multiple of it.
constexpr double kStaysWithin = 10.0;
/// Displacement up to which a grain may go on moving in the test of stability if it becomes slower, in the same units.
constexpr double kSettlesWithin = 50.0;
/// A contact counts as force-free if its force, divided by the mean repulsive force, is at most this number.
constexpr double kCarries = 1e-9;
/// A contact counts as sliding if the difference between its tangential force and the Coulomb limit, divided by the
/// limit, is at most this number.
constexpr double kAtLimit = 1e-9;

/// Returns the choice of the recorded forces of a packing at rest. At a minimum of the volume there is no last step
/// whose forces could be recorded, and the closest forces are recorded instead.
template <int Dim>
RigidForces forces_at_rest(const RelaxationOptions& options, const Packing<Dim>& packing) {
  const RigidForces chosen = options.contact_dynamics.forces;
  return chosen == RigidForces::stepped && are_smooth_polyhedra(packing) ? RigidForces::closest : chosen;
}

/// Subtracts the adhesion of the contact law from the normal forces of all contacts, and removes contacts that have a
/// gap and have not adhered, since these contacts have no force.
template <int Dim>
void hold_adhesion(Packing<Dim>& packing) {
  std::erase_if(packing.contacts, [&](const Contact<Dim>& c) {
    return packing.law_of(c).pull_off_force() > 0.0 && c.gap > 0.0 && c.elastic_force == 0.0;
  });
  for (Contact<Dim>& c : packing.contacts)
    c.normal_force = c.elastic_force - packing.law_of(c).pull_off_force();
}

/// Returns the displacement of each grain relative to its diameter. A drift of the walls together with all grains
/// between them does not count, nor does a strain of the cell.
template <int Dim>
std::vector<double> displacements(const Packing<Dim>& from, const Packing<Dim>& to) {
  const Packing<Dim> before = with_walls_at_cell(from), now = with_walls_at_cell(to);
  std::vector<double> out;
  for (int i = 0; i < from.grains.size(); ++i) {
    const Vec<Dim> carried_along = now.cell.matrix.transpose() * before.cell.reduced(before.grains.position[i]);
    out.push_back((now.grains.position[i] - carried_along).norm() / (2.0 * from.grains.radius[i]));
  }
  return out;
}

}  // namespace

template <int Dim>
void ContactDynamicsRelaxer<Dim>::start_resting() {
  progress_.phase = ContactDynamicsProgress::resting;
  progress_.time_step = 0.0;
  if (!is_elastic()) {
    // Grains that have rested before continue with the time step that they had reached.
    const bool are_many = packing_.grains.size() > kManyGrains && !packing_.grains.are_round();
    if (progress_.rest_length == 0.0) progress_.rest_length = are_many ? kLongestRestOfMany : kLongestRest;
    return;
  }
  ++progress_.n_rests;
  progress_.rest_length = kLongestOnSprings;
  progress_.resting_steps = progress_.least_at = 0;
  progress_.least_residual = progress_.tried_residual = 0.0;
}

template <int Dim>
double ContactDynamicsRelaxer<Dim>::gap_tolerance() const {
  return options_.contact_dynamics.gap_tolerance.value_or(default_gap_tolerance(packing_));
}

template <int Dim>
RelaxationStatus ContactDynamicsRelaxer<Dim>::rest() {
  if (are_smooth_polyhedra(packing_)) return rest_at_least_volume();
  return rest_in_steps();
}

/// Makes steps of the phase `resting`, then seeks balanced forces if the net forces are small or if the last search was
/// many steps ago.
template <int Dim>
RelaxationStatus ContactDynamicsRelaxer<Dim>::rest_in_steps() {
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

/// Moves polyhedra without friction to a minimum of P V, or near one, and then seeks balanced forces. After a failure,
/// the grains move under the load again before the next search.
template <int Dim>
RelaxationStatus ContactDynamicsRelaxer<Dim>::rest_at_least_volume() {
  if constexpr (Dim == 3) {
    Packing<3> least = packing_;
    const LeastVolume found = minimise_volume(least, boundary_load(), gap_tolerance());
    progress_.n_steps += found.n_steps;
    progress_.resting_steps += std::max(found.n_steps, kSteps);
    packing_ = std::move(least);
    wrap_into_cell(packing_);
    measure();
    progress_.obstacle = found.failure;
    if (found.failure.empty() && find_forces_at_minimum(found.is_near)) return RelaxationStatus::converged;
    if (progress_.resting_steps < kMostRestingSteps) {
      start_moving();
      return RelaxationStatus::running;
    }
  }
  return RelaxationStatus::gave_up;
}

/// Seeks balanced forces in a packing at a minimum of P V. If the packing is only near a minimum, as that of rounded
/// polyhedra, it makes steps until its forces balance.
template <int Dim>
bool ContactDynamicsRelaxer<Dim>::find_forces_at_minimum(bool is_near) {
  if (find_balanced_forces()) return true;
  if (!is_near) return false;
  for (int k = 0; k < kTrialsNearMinimum; ++k) {
    check_interruption();
    make_steps(kSteps);
    if (find_balanced_forces()) return true;
  }
  return false;
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

/// Returns the deepest overlap of the contacts, divided by the diameter of the smaller grain. If the contacts of a step
/// without friction are solved all at once, the gaps of contacts with a force count, too, as long as the force exceeds
/// the errors of the balance.
template <int Dim>
double ContactDynamicsRelaxer<Dim>::largest_gap(bool is_exact) const {
  const double least = near_balance() * mean_repulsive_force(packing_);
  double largest = 0.0;
  for (const Contact<Dim>& c : packing_.contacts) {
    const bool counts = is_exact && c.elastic_force > least;
    largest = std::max(largest, (counts ? std::abs(c.gap) : -c.gap) / (2.0 * smaller_radius(packing_, c)));
  }
  return largest;
}

/// Replaces the forces of the last step by forces that balance all grains exactly. Returns false if there are no such
/// forces.
template <int Dim>
bool ContactDynamicsRelaxer<Dim>::find_balanced_forces() {
  const double tolerance = gap_tolerance();
  const bool is_exact = solves_at_once() && packing_.law.friction_coefficient() == 0.0;
  const double reached_gap = is_exact ? std::min(tolerance, kGapAtOnce)
                                      : tolerance * (packing_.grains.are_round() ? 1.0 : kOverlapWithCorners);
  if (const double gap = largest_gap(is_exact); gap > reached_gap) {
    progress_.obstacle = fmt::format(
        "the {} is {:.2g} times the diameter of the smaller grain, but the tolerance is {:.2g}",
        is_exact ? "largest gap of a contact with a force, or the deepest overlap," : "deepest overlap", gap,
        reached_gap);
    // Errors of the impulses displace grains in proportion to the square of the time step, so the longest step is
    // halved.
    if (!solves_at_once()) progress_.rest_length = std::max(0.5 * progress_.rest_length, kShortestRest);
    return false;
  }
  Packing<Dim> rested = packing_;
  stop_all_bodies(rested);
  rested.contacts = ContactPoints<Dim>().find_touching(rested, tolerance);
  carry_forces(rested, packing_.contacts, rested.contacts);
  hold_adhesion(rested);
  if (rested.contacts.empty()) {
    progress_.obstacle = "no grains touch each other";
    start_moving();
    return false;
  }
  try {
    if (forces_at_rest(options_, rested) != RigidForces::stepped) set_balanced_forces(rested);
  } catch (const NoResult& reason) {
    progress_.obstacle = reason.what();
    // A grain still moves. Steps that are solved all at once move it on, too; steps that are solved by sweeps, each of
    // which begins at rest, move it slowly.
    if (!solves_at_once()) start_moving(kMoreCalmSteps);
    return false;
  }
  const Mat<Dim> stress = static_stress(rested);
  const Residuals reached = residuals(rested, load_.stress_with(stress), stress);
  if (!reached.within(options_.tolerance)) {
    progress_.obstacle = worst_residual(reached, options_.tolerance, rested.grains.id);
    return false;
  }
  // Polyhedra without friction are at a minimum of P V, which is stable.
  if (!are_smooth_polyhedra(rested) && !stays_in_place(rested)) {
    progress_.obstacle =
        "the equilibrium is unstable: grains leave their places when the packing is free to move";
    start_moving(kMoreCalmSteps);
    return false;
  }
  packing_ = std::move(rested);
  stress_ = stress;
  target_ = load_.stress_with(stress);
  residuals_ = reached;
  const std::string names[] = {"closest", "canonical", "stepped"};
  ending_ = names[static_cast<int>(forces_at_rest(options_, packing_))];
  return true;
}

/// Returns whether the grains with contacts stay in place when the packing is free to move for some steps. The test
/// finds packings whose forces are balanced, but whose equilibrium is unstable: grains that leave such an equilibrium
/// become faster. Grains that leave their places, but become slower, are settling.
template <int Dim>
bool ContactDynamicsRelaxer<Dim>::stays_in_place(const Packing<Dim>& rested) const {
  std::vector<bool> carries(rested.grains.size(), false);
  for (const Contact<Dim>& c : rested.contacts) {
    carries[c.i] = true;
    if (!rested.is_wall(c.j)) carries[c.j] = true;
  }
  ContactDynamicsSettings chosen = settings();
  chosen.longest_step = options_.contact_dynamics.time_step * time_unit_;
  if (is_elastic()) {
    chosen.at_once = false;
  } else {
    chosen.sweep_tolerance = options_.contact_dynamics.sweep_tolerance;
    chosen.max_sweeps = kFreeSweeps;
  }
  ContactDynamics<Dim> motion(rested, boundary_load(), chosen, chosen.longest_step);
  const auto moved_further = [&] {
    for (int k = 0; k < kFreeSteps; ++k) motion.step(false);
    return displacements(rested, motion.packing());
  };
  const std::vector<double> first = moved_further();
  const double within = kStaysWithin * gap_tolerance(), settles = kSettlesWithin * gap_tolerance();
  bool stays = true;
  for (std::size_t i = 0; i < first.size(); ++i) stays = stays && (!carries[i] || first[i] <= within);
  if (stays) return true;
  const std::vector<double> second = moved_further();
  for (std::size_t i = 0; i < first.size(); ++i)
    if (carries[i] && second[i] > within && (second[i] > settles || second[i] >= 2.0 * first[i])) return false;
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
  // The caller compares the residuals of the forces with all tolerances.
  options.accepted_error = options_.tolerance.force;
  StaticForces<Dim> forces("the packing", packing, options);
  const bool closest = forces_at_rest(options_, packing) == RigidForces::closest;
  const bool avoids_gaps = !packing.grains.are_round() && !are_smooth_polyhedra(packing);
  const BalancedForces<Dim> found =
      closest ? forces.closest(avoids_gaps ? kCostlyGap : 0.0) : forces.canonical();
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

#define FLOC_INSTANTIATE(Dim)                                         \
  template void ContactDynamicsRelaxer<Dim>::start_resting();         \
  template double ContactDynamicsRelaxer<Dim>::gap_tolerance() const; \
  template RelaxationStatus ContactDynamicsRelaxer<Dim>::rest();
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
