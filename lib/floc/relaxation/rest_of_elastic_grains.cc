// Member functions of class ContactDynamicsRelaxer for elastic grains that come to rest on the springs of their
// contacts.

#include <algorithm>
#include <string>

#include "floc/packing/balance.h"
#include "floc/relaxation/contact_dynamics_relaxer.h"
#include "floc/relaxation/spring_balance.h"
#include "floc/rigid/elastic_contacts.h"

namespace floc {
namespace {

/// Number of time steps between two tests of the balance. Each step is a Newton step.
constexpr int kNewtonSteps = 2;
/// The Newton steps end as soon as all residuals, in the units of EquilibriumTolerance, are at most this number.
constexpr double kBalanced = 1e-9;
/// Newton iterations with the whole tangent matrix (balance_springs()) are tried if all residuals are at most kNearBalance,
/// and again whenever the largest residual has fallen to kNextTrial times that of the last trial.
constexpr double kNearBalance = 1.0;
constexpr double kNextTrial = 0.1;
/// A packing at rest moves under its load, before any Newton step, if a residual is above this number: its springs carry
/// half of the load or less.
constexpr double kSmallChange = 0.5;
/// Number of steps after which a packing within the tolerances of the scene is accepted, although its residuals are
/// larger than kBalanced.
constexpr int kEnoughSteps = 60;
/// A series of Newton steps ends without success after kMostNewtonSteps steps, or if the residual has not fallen to
/// less than half in kMostStalledSteps steps. The grains then move under the load again until they are calm, and a new
/// series begins.
constexpr int kMostNewtonSteps = 200;
constexpr int kMostStalledSteps = 60;
/// Number of series of Newton steps without success after which the relaxation is given up.
constexpr int kMostRests = 6;
/// Whenever the residual has not fallen to less than half in kStalledSteps steps, the next steps are half as long, but
/// not shorter than kShortestOnSprings (in units of T). Longer steps may alternate between two sets of contact points.
constexpr int kStalledSteps = 16;
constexpr double kShortestOnSprings = 0.1;

/// Under gravity, a series of Newton steps ends as soon as a step is shorter than this share of its intended length. Steps
/// are shortened so much if a grain has lost its support and falls: it comes down in motion, while steps from rest would
/// let it sink by a small distance each. A bed of 100 polyhedra under a lid came to rest in 81 s instead of 362 s.
constexpr double kFalls = 0.02;

/// Returns the end of a message about grains that do not come to rest; empty if the contact forces change continuously
/// with the positions of the grains.
template <int Dim>
std::string reason_of_corners(const Grains<Dim>& grains, bool frictionless) {
  const auto is_sharp = [](const Shape<Dim>& shape) { return !shape.is_round() && shape.rounding == 0.0; };
  const auto has_faces = [](const Shape<Dim>& shape) { return Dim == 3 && shape.n_vertices() > 2; };
  if (std::ranges::any_of(*grains.shapes, is_sharp))
    return "; the force between sharp corners jumps when other corners come into contact, so that "
           "there may be no balance: expected rounded corners (grains.shape.rounding)";
  if (frictionless && std::ranges::any_of(*grains.shapes, has_faces))
    return "; contact points between two faces appear and vanish abruptly as the faces move, so "
           "that there may be no balance without friction";
  return "";
}

double largest_of(const Residuals& r) {
  return std::max({r.force, r.moment, r.stress});
}

}  // namespace

/// Returns to the phase in which the grains move under the load.
/// @param more_calm_steps  number of calm steps, beyond the usual number, after which the phase ends; the usual number
/// is enough once a step has not been calm
template <int Dim>
void ContactDynamicsRelaxer<Dim>::start_moving(int more_calm_steps) {
  progress_.phase = ContactDynamicsProgress::moving;
  progress_.calm_steps = -more_calm_steps;
  progress_.time_step = 0.0;
}

/// Makes time steps from rest, and ends the relaxation if the forces of the springs balance.
template <int Dim>
RelaxationStatus ContactDynamicsRelaxer<Dim>::rest_on_springs() {
  if (progress_.resting_steps == 0) {
    if (springs_balance()) return RelaxationStatus::converged;
    if (progress_.phase != ContactDynamicsProgress::resting) return RelaxationStatus::running;
    // A packing that began at rest rearranges if it is far from a balance. This takes far less time in motion than in
    // Newton steps.
    if (progress_.time == 0.0 && progress_.least_residual > kSmallChange) {
      start_moving();
      return RelaxationStatus::running;
    }
  }
  make_steps(kNewtonSteps);
  progress_.resting_steps += kNewtonSteps;
  if (springs_balance()) return RelaxationStatus::converged;
  const bool falls =
      !packing_.gravity.isZero(0.0) && progress_.last_step < kFalls * progress_.rest_length * time_unit_;
  const int stalled = progress_.resting_steps - progress_.least_at;
  if (stalled > 0 && stalled % kStalledSteps == 0)
    progress_.rest_length = std::max(0.5 * progress_.rest_length, kShortestOnSprings);
  const bool is_stuck = falls || stalled >= kMostStalledSteps || progress_.resting_steps >= kMostNewtonSteps;
  if (!is_stuck) return RelaxationStatus::running;
  if (progress_.n_rests < kMostRests) {
    start_moving();
    return RelaxationStatus::running;
  }
  progress_.obstacle += reason_of_corners(packing_.grains, packing_.law.friction_coefficient() == 0.0);
  return RelaxationStatus::gave_up;
}

/// Tests whether the forces of the contact law balance all grains and the stress, and whether this equilibrium is
/// stable. If so, replaces the packing by the packing at rest, in which the contacts are the overlaps.
template <int Dim>
bool ContactDynamicsRelaxer<Dim>::springs_balance() {
  // The forces of the last time step cannot be tested: they balance the change of momentum in this step, and the
  // contact list also contains points with gaps. The test therefore uses a copy at rest, in which the gaps give the
  // normal forces. If the test fails, the motion continues from the unchanged packing.
  Packing<Dim> rested = packing_;
  stop_all_bodies(rested);
  rested.contacts = ContactPoints<Dim>().find(rested, 0.0);
  carry_forces(rested, packing_.contacts, rested.contacts);
  set_spring_forces(rested);
  const Mat<Dim> stress = static_stress(rested);
  const Residuals reached = residuals(rested, load_.stress_with(stress), stress);
  // Only a fall to less than half of the smallest residual counts as progress. Otherwise a residual that falls by a
  // tiny amount in each step would never count as stalled. The value zero means that no residual has been measured yet.
  if (progress_.least_residual == 0.0 || largest_of(reached) < 0.5 * progress_.least_residual) {
    progress_.least_residual = largest_of(reached);
    progress_.least_at = progress_.resting_steps;
  }
  if (newton_iterations_balance(rested, largest_of(reached))) return true;
  if (!reached.within(options_.tolerance)) {
    progress_.obstacle = worst_residual(reached, options_.tolerance, rested.grains.id);
    return false;
  }
  if (largest_of(reached) > kBalanced && progress_.resting_steps < kEnoughSteps) {
    progress_.obstacle = "the residuals are within their tolerances, but Newton steps still reduce them";
    return false;
  }
  // This test comes last, because it makes many time steps. Balanced forces alone do not show that an equilibrium is
  // stable.
  if (!stays_in_place(rested)) {
    progress_.obstacle = "the balance is unstable: grains leave their places when the packing is free to move";
    start_moving();
    return false;
  }
  accept(std::move(rested));
  return true;
}

/// Tries to balance the springs of a packing at rest by Newton iterations with the whole tangent matrix, and ends the
/// relaxation if this succeeds. Nothing is tried if the residual is too large, or nearly as large as in the last trial.
/// @param residual  largest residual of the packing, in the units of EquilibriumTolerance
template <int Dim>
bool ContactDynamicsRelaxer<Dim>::newton_iterations_balance(const Packing<Dim>& rested, double residual) {
  if (rested.grains.are_round()) return false;
  const bool is_first = progress_.tried_residual == 0.0;
  if (residual > (is_first ? kNearBalance : kNextTrial * progress_.tried_residual)) return false;
  progress_.tried_residual = residual;
  SpringBalance<Dim> balanced = balance_springs(rested, load_, kBalanced);
  if (!balanced.converged || !balanced.residuals.within(options_.tolerance)) return false;
  if (!stays_in_place(balanced.packing)) return false;
  accept(std::move(balanced.packing));
  return true;
}

/// Ends the relaxation with a packing whose springs balance.
template <int Dim>
void ContactDynamicsRelaxer<Dim>::accept(Packing<Dim> balanced) {
  packing_ = std::move(balanced);
  measure();
  stability_ = stability_at_rest(packing_);
  ending_ = "polished";
}

template void ContactDynamicsRelaxer<2>::start_moving(int);
template void ContactDynamicsRelaxer<3>::start_moving(int);
template RelaxationStatus ContactDynamicsRelaxer<2>::rest_on_springs();
template RelaxationStatus ContactDynamicsRelaxer<3>::rest_on_springs();
template bool ContactDynamicsRelaxer<2>::springs_balance();
template bool ContactDynamicsRelaxer<3>::springs_balance();
template bool ContactDynamicsRelaxer<2>::newton_iterations_balance(const Packing<2>&, double);
template bool ContactDynamicsRelaxer<3>::newton_iterations_balance(const Packing<3>&, double);
template void ContactDynamicsRelaxer<2>::accept(Packing<2>);
template void ContactDynamicsRelaxer<3>::accept(Packing<3>);

}  // namespace floc
