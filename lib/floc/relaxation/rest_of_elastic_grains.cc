// Member functions of class ContactDynamicsRelaxer for elastic grains that come to rest on the springs of their contacts.

#include <algorithm>
#include <string>

#include "floc/packing/balance.h"
#include "floc/relaxation/contact_dynamics_relaxer.h"
#include "floc/rigid/elastic_contacts.h"

namespace floc {
namespace {

/// Number of time steps between two tests of the balance. Each step is a Newton step.
constexpr int kNewtonSteps = 2;
/// Largest residual at which the steps end at once, in the units of EquilibriumTolerance.
constexpr double kBalanced = 1e-9;
/// Number of steps after which a packing within the tolerances of the scene is accepted, although its residuals are
/// larger than kBalanced.
constexpr int kEnoughSteps = 60;
/// Number of steps after which the relaxation is given up.
constexpr int kMostNewtonSteps = 200;

/// Returns the end of a message about grains that find no rest; empty if no grain has sharp corners.
template <int Dim>
std::string reason_of_corners(const Grains<Dim>& grains) {
  const auto is_sharp = [](const Shape<Dim>& shape) { return !shape.is_round() && shape.rounding == 0.0; };
  if (std::ranges::none_of(*grains.shapes, is_sharp)) return "";
  return "; the force between sharp corners jumps where the corners that meet change, so that there may be no "
         "balance: "
         "expected rounded corners (grains.shape.rounding)";
}

double largest_of(const Residuals& r) {
  return std::max({r.force, r.moment, r.stress});
}

}  // namespace

/// Makes time steps from rest, and ends the relaxation if the forces of the springs balance.
template <int Dim>
RelaxationStatus ContactDynamicsRelaxer<Dim>::rest_on_springs() {
  make_steps(kNewtonSteps);
  progress_.resting_steps += kNewtonSteps;
  if (springs_balance()) return RelaxationStatus::converged;
  if (progress_.resting_steps < kMostNewtonSteps) return RelaxationStatus::running;
  if (progress_.time ==
      0.0) {  // the relaxation began with these steps, and the grains have not moved freely yet
    progress_.phase = ContactDynamicsProgress::moving;
    progress_.resting_steps = 0;
    progress_.time_step = 0.0;
    return RelaxationStatus::running;
  }
  progress_.obstacle += reason_of_corners(packing_.grains);
  return RelaxationStatus::gave_up;
}

/// Tests whether the forces of the contact law balance all grains and the stress in a stable way, and then replaces the
/// packing by the packing at rest, whose contacts are the overlaps.
template <int Dim>
bool ContactDynamicsRelaxer<Dim>::springs_balance() {
  Packing<Dim> rested = packing_;
  stop_grains(rested);
  rested.contacts = ContactPoints<Dim>().find(rested, 0.0);
  carry_forces(rested, packing_.contacts, rested.contacts);
  set_spring_forces(rested);
  const Mat<Dim> stress = static_stress(rested);
  const Residuals reached = residuals(rested, load_.stress_with(stress), stress);
  if (!reached.within(options_.tolerance)) {
    progress_.obstacle = worst_residual(reached, options_.tolerance, rested.grains.id);
    return false;
  }
  if (largest_of(reached) > kBalanced && progress_.resting_steps < kEnoughSteps) {
    progress_.obstacle = "the residuals are within their tolerances, and are still reduced further";
    return false;
  }
  if (!stays_in_place(rested)) {
    progress_.obstacle = "the balance is unstable: grains leave their places when the packing is free to move";
    progress_.phase = ContactDynamicsProgress::moving;
    progress_.calm_steps = 0;
    progress_.time_step = 0.0;
    return false;
  }
  packing_ = std::move(rested);
  stress_ = stress;
  target_ = load_.stress_with(stress);
  residuals_ = reached;
  stability_ = stability_at_rest(packing_);
  ending_ = "polished";
  return true;
}

template RelaxationStatus ContactDynamicsRelaxer<2>::rest_on_springs();
template RelaxationStatus ContactDynamicsRelaxer<3>::rest_on_springs();
template bool ContactDynamicsRelaxer<2>::springs_balance();
template bool ContactDynamicsRelaxer<3>::springs_balance();

}  // namespace floc
