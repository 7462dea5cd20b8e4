#include "floc/relaxation/relaxer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "floc/elasticity/stability.h"
#include "floc/neighbors/find_contacts.h"
#include "floc/neighbors/spread_liquid.h"
#include "floc/packing/grain_sizes.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/packing/require_periodic.h"
#include "floc/relaxation/dynamics.h"
#include "floc/relaxation/elastic_step.h"
#include "floc/relaxation/static_solver.h"

namespace floc {
namespace {

/// The motion of a packing counts as stopped if its kinetic energy is within the tolerance and the packing is steady.
/// The packing is steady if the solid fraction has changed by less than kSteadyPhi in kSteadyWindow time units, or if
/// no contact has opened or closed in kSteadyContactsWindow time units. (If power control began earlier, it would
/// change the rearrangements of the grains.)
constexpr double kSteadyPhi = 2e-5;
constexpr double kSteadyWindow = 5.0;
constexpr double kSteadyContactsWindow = 20.0;
/// Criterion by which the motion of the grains counts as vibration. Vibrations of contact springs below their caps do
/// not end, since nothing dissipates their energy. The kinetic energy of vibrations may therefore be above its
/// tolerance. The criterion is that no contact has opened or closed for a long time. This time has to be at least
/// kVibrationWindows times kSteadyContactsWindow time units, and so long that the grains, at their r.m.s. speed, would
/// cover a path of kVibrationPath largest diameters. Grains that move freely meet another grain earlier: in five
/// example scenes with 200 or 400 grains and an energy above its tolerance, the longest path was half a diameter, and
/// the longest time under load was twice kSteadyContactsWindow.
constexpr double kVibrationPath = 2.0;
constexpr double kVibrationWindows = 5.0;
/// If the density has been steady for this time (in time units), only chains of freely rolling grains can still be
/// moving. Such chains swing between their ends without damping, with a kinetic energy above its tolerance. The time is
/// twice the duration of the longest load step in the example scenes. During this time the solid fraction may change by
/// kFinishPhi.
constexpr double kMechanismWindow = 200.0;
/// Number of Newton iterations before the decision whether a load step is elastic. The first iteration gives the
/// elastic response.
constexpr int kTrialIterations = 2;
/// Largest change of the solid fraction during the final phase of a relaxation (power control and Newton steps). A
/// packing with a larger change has rearranged and then moves freely again.
constexpr double kFinishPhi = 1e-4;
/// Largest changes of the stress on axes with an imposed length, in units of F1/a^(D-1). kSteadyStress applies to the
/// time window in which a packing has to be steady, kFinishStress to the final phase of the relaxation (power control
/// and Newton steps). F1 is the force scale, a the largest diameter and D the dimension.
constexpr double kSteadyStress = 1e-3;
constexpr double kFinishStress = 1e-2;
/// Cap on the inertial number |L'/L| sqrt(m/(P a^(D-2))) of the cell in scenes without adhesion that set no cap.
constexpr double kDefaultInertialNumber = 1e-3;
/// Largest number of equilibria that are rejected in one relaxation because sharing out the liquid once more would
/// change the liquid bridges.
constexpr int kLiquidTrials = 20;
/// Newton refinement of the packing is tried when the force residual is below this value; the refinement then usually
/// succeeds.
constexpr double kRefinementResidual = 5e-3;
/// Shortest pause after a failed Newton refinement, in chunks of time steps. The pause grows with the duration of the
/// final phase of the relaxation.
constexpr int kRefinementPause = 8;

template <int Dim>
double first_skin(const RelaxationOptions& options, const Grains<Dim>& grains) {
  return options.skin ? *options.skin * largest_diameter(grains) : 0.05 * skin_length_unit(grains.radius);
}

/// Returns the mean kinetic energy per grain (energy). The energy of each grain is divided by the ratio of its own
/// energy scale to that of the packing. Grains without contacts contribute nothing, since they do not belong to the
/// structure that carries forces. The rotation of a sphere with fewer than three contacts is left out, too: nothing
/// damps its spin about a single contact, or about the line through two contacts.
template <int Dim>
double energy_of_connected_grains(const Packing<Dim>& packing, const GrainScales<Dim>& scales) {
  std::vector<int> n_contacts(packing.grains.size(), 0);
  for (const Contact<Dim>& c : packing.contacts) ++n_contacts[c.i], ++n_contacts[c.j];
  if constexpr (Dim == 2) {
    std::vector<bool> touched;
    for (const int n : n_contacts) touched.push_back(n > 0);
    return scaled_kinetic_energy(packing, scales, touched);
  } else {
    const Grains<Dim>& g = packing.grains;
    double sum = 0.0;
    for (int i = 0; i < g.size(); ++i) {
      if (n_contacts[i] == 0) continue;
      double twice = g.mass[i] * g.velocity[i].squaredNorm();
      if (n_contacts[i] >= 3) twice += g.inertia(i) * g.angular_velocity[i].squaredNorm();
      sum += twice / scales.work_share(i);
    }
    return g.size() == 0 ? 0.0 : 0.5 * sum / g.size();
  }
}

/// Estimate of the number of time steps of the motion from one equilibrium to the next.
constexpr double kSettlingSteps = 5000.0;
/// Computing time per time step and contact on one core, in seconds (docs/performance.md, "Steps").
constexpr double kSecondsPerContact = 8e-8;

/// Returns a fingerprint of the set of pairs of grains that touch (FNV-1a hash).
template <int Dim>
std::uint64_t contact_fingerprint(const Packing<Dim>& packing) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  const auto mix = [&hash](int value) { hash = (hash ^ static_cast<std::uint32_t>(value)) * 0x100000001b3ULL; };
  for (const Contact<Dim>& c : packing.contacts) {
    if (c.distant) continue;
    mix(c.i);
    mix(c.j);
  }
  return hash;
}

}  // namespace

template <int Dim>
double inertial_time(const Packing<Dim>& packing, const Vec<Dim>& target_stress) {
  const ForceScale scale = force_scale(packing, target_stress);
  return std::sqrt(scale.length * largest_mass(packing.grains) / scale.force);
}

template <int Dim>
double strain_rate_cap(const RelaxationOptions& options, const Packing<Dim>& packing,
                       const Vec<Dim>& target_stress) {
  const double a = force_scale(packing, target_stress).length;
  const double m = largest_mass(packing.grains);
  const double F0 = pull_off_force(packing);
  if (options.strain_rate_cap && F0 > 0.0) return *options.strain_rate_cap * std::sqrt(F0 / (a * m));
  if (options.inertial_number_cap || F0 == 0.0)
    return options.inertial_number_cap.value_or(kDefaultInertialNumber) *
           std::sqrt(std::max(target_stress.mean(), 0.0) * std::pow(a, Dim - 2) / m);
  return std::numeric_limits<double>::infinity();
}

template <int Dim>
Relaxer<Dim>::Relaxer(const RelaxationOptions& options, Packing<Dim> packing, const LoadTarget<Dim>& load,
                      RelaxationProgress progress)
    : options_(options),
      packing_(std::move(packing)),
      load_(load),
      target_(load.stress),
      progress_(std::move(progress)) {
  require_periodic(packing_, "a relaxation under stresses or lengths imposed on the cell is possible");
  measure();
  time_step_ = time_step_of(packing_, options.time_step, std::max(target_.mean(), 0.0));
  if (progress_.skin == 0.0) progress_.skin = first_skin(options, packing_.grains);
  if (load_.any_strained() && progress_.side_before.empty()) begin_strain_ramp();
  if (progress_.imbalance_sign.empty() && !strain_ramp().any()) begin_response();
}

/// Records the sign of the difference between the stress and its target for each axis with an imposed stress. Later,
/// responded_to_load() tests whether the sign has changed. For axes with an imposed length, 0 is recorded.
template <int Dim>
void Relaxer<Dim>::begin_response() {
  const Vec<Dim> imbalance = stress_.diagonal() - target_;
  for (int a = 0; a < Dim; ++a)
    progress_.imbalance_sign.push_back(load_.strained(a) ? 0.0 : imbalance[a] < 0.0 ? -1.0 : 1.0);
}

template <int Dim>
RelaxationStatus Relaxer<Dim>::advance() {
  if (progress_.n_steps == 0 && load_.any_strained() && !overfilled_cell_error().empty()) {
    ending_ = "closed";
    return RelaxationStatus::gave_up;
  }
  // Newton steps ignore velocities, so they are tried only at rest.
  const bool at_rest = residuals_.energy < options_.tolerance.energy;
  if (options_.finish != Finish::dynamic && progress_.n_steps == 0 && at_rest && !load_.unloaded() &&
      solve_without_motion())
    return RelaxationStatus::converged;
  if (carries_no_stress() && (progress_.n_steps == 0 || strain_ramp().over(0.0))) {
    ending_ = "unloaded";
    return RelaxationStatus::gave_up;
  }
  auto control =
      BoundaryControl<Dim>::imposing(load_, target_, options_.cell_mass * total_mass(packing_.grains),
                                     strain_rate_cap(options_, packing_, target_));
  control.ramp = strain_ramp();
  const double pressure = std::max(target_.mean(), 0.0);
  time_step_ = time_step_of(packing_, options_.time_step, pressure);
  if (control.any_stress())
    time_step_ = std::min(time_step_, cell_time_step_of(packing_, control.mass, options_.time_step, pressure));
  const bool finishing = progress_.phase == RelaxationProgress::finishing;
  DynamicsSettings settings{time_step_, progress_.skin, options_.threads};
  settings.holds_liquid = finishing;
  auto dynamics = make_dynamics(packing_, control, settings);
  advance_observed(*dynamics, kStepsPerChunk, finishing ? Motion::power_control : Motion::free, observer_,
                   progress_.time, time_step_);
  if (!dynamics->finite()) {
    ending_ = "diverged";
    find_contacts(packing_);
    measure();
    return RelaxationStatus::gave_up;
  }
  packing_ = {};
  packing_ = dynamics->release_packing();
  if (!options_.skin) progress_.skin = dynamics->skin();
  dynamics.reset();
  progress_.n_steps += kStepsPerChunk;
  progress_.time += kStepsPerChunk * time_step_;

  measure();
  progress_.force_residual.push_back(residuals_.force);
  if (progress_.force_residual.size() > 10) progress_.force_residual.erase(progress_.force_residual.begin());
  const RelaxationStatus status = finishing ? check_finish() : check_motion();
  if (status == RelaxationStatus::running &&
      progress_.time - progress_.ramp_duration > options_.max_time * time_unit_)
    return RelaxationStatus::gave_up;
  return status;
}

/// Whether, on each axis, the difference between the stress and its target has changed sign since the start or is
/// within tolerance. Without this test, a packing under a small increment of load would count as being in equilibrium
/// before it has moved.
template <int Dim>
bool Relaxer<Dim>::responded_to_load() {
  const Vec<Dim> imbalance = stress_.diagonal() - target_;
  bool responded = true;
  for (int a = 0; a < Dim; ++a) {
    if (imbalance[a] * progress_.imbalance_sign[a] < 0.0) progress_.imbalance_sign[a] = 0.0;
    responded = responded && progress_.imbalance_sign[a] == 0.0;
  }
  return responded || residuals_.stress < options_.tolerance.stress;
}

template <int Dim>
bool Relaxer<Dim>::density_is_steady() {
  std::vector<double>& phi = progress_.solid_fraction;
  phi.push_back(solid_fraction(packing_));
  const std::size_t window = chunks_in(kSteadyWindow) + 1;
  // If the time step has grown, fewer chunks of time steps fill the window, and more than one entry is removed.
  while (phi.size() > window) phi.erase(phi.begin());
  const auto [low, high] = std::minmax_element(phi.begin(), phi.end());
  return phi.size() == window && *high - *low < kSteadyPhi && carried_stress_is_steady(window);
}

/// Whether the stress on the axes with an imposed length is steady. At imposed lengths the density is constant and does
/// not show whether the grains have stopped rearranging.
template <int Dim>
bool Relaxer<Dim>::carried_stress_is_steady(std::size_t window) {
  if (!load_.any_strained()) return true;
  std::vector<double>& carried = progress_.carried_stress;
  carried.push_back(mean_carried_stress());
  while (carried.size() > window) carried.erase(carried.begin());
  const auto [low, high] = std::minmax_element(carried.begin(), carried.end());
  return carried.size() == window && *high - *low < kSteadyStress * stress_scale();
}

/// Returns F1/a^(D-1), the unit for changes of the stress on axes with an imposed length (force/length^(Dim-1)), with
/// the force scale F1, the largest diameter a and the dimension D.
template <int Dim>
double Relaxer<Dim>::stress_scale() const {
  const ForceScale scale = force_scale(packing_, target_);
  return scale.force / std::pow(scale.length, Dim - 1);
}

/// Whether no contact has opened or closed for so long that the packing has stopped rearranging. This test is needed
/// where the density never becomes steady, either because of undamped vibrations, or because a packing without load and
/// with many motions without stiffness moves freely.
template <int Dim>
bool Relaxer<Dim>::contacts_are_steady() {
  const std::uint64_t set = contact_fingerprint(packing_);
  progress_.unchanged_chunks = set == progress_.contact_set ? progress_.unchanged_chunks + 1 : 0;
  progress_.contact_set = set;
  return progress_.unchanged_chunks >= static_cast<int>(chunks_in(kSteadyContactsWindow));
}

/// Whether no contact has opened or closed for so long that grains with this mean kinetic energy can only be vibrating
/// (kVibrationPath).
/// @param energy  mean kinetic energy of a grain (energy)
template <int Dim>
bool Relaxer<Dim>::vibrates(double energy) const {
  const double time = progress_.unchanged_chunks * kStepsPerChunk * time_step_;
  const double path = std::sqrt(2.0 * energy / largest_mass(packing_.grains)) * time;
  return path > kVibrationPath * force_scale(packing_, target_).length &&
         progress_.unchanged_chunks >= static_cast<int>(chunks_in(kVibrationWindows * kSteadyContactsWindow));
}

/// Whether a packing under load has kept its density for so long that only mechanisms (motions without stiffness) can
/// be moving.
template <int Dim>
bool Relaxer<Dim>::only_mechanisms_move(bool steady_density) {
  const double phi = progress_.solid_fraction.back();
  if (!steady_density || std::abs(phi - progress_.steady_since_phi) > kFinishPhi) {
    progress_.steady_chunks = 0;
    progress_.steady_since_phi = phi;
    return false;
  }
  return ++progress_.steady_chunks >= static_cast<int>(chunks_in(kMechanismWindow));
}

template <int Dim>
std::size_t Relaxer<Dim>::chunks_in(double time_units) const {
  return static_cast<std::size_t>(
      std::ceil(options_.patience * time_units * time_unit_ / (kStepsPerChunk * time_step_)));
}

/// Begins the final phase of the relaxation (power control and Newton steps) once motion has stopped, that is, once
/// three conditions are met: the packing is steady, the stress has responded to the load, and the kinetic energy is
/// small or belongs to vibrations or mechanisms alone.
template <int Dim>
RelaxationStatus Relaxer<Dim>::check_motion() {
  unmet_ = {Demand::lengths};
  if (progress_.imbalance_sign.empty()) {
    if (!strain_ramp().over(0.0)) return RelaxationStatus::running;
    begin_response();
  }
  // advance() gives the relaxation up at the beginning of the next chunk of time steps.
  if (carries_no_stress()) return RelaxationStatus::running;
  const bool responded = responded_to_load();
  const bool steady_density = density_is_steady();
  const bool steady_contacts = contacts_are_steady();
  const bool unloaded = load_.unloaded();
  const bool coasting = !unloaded && only_mechanisms_move(steady_density);
  const bool steady = (responded && steady_density) || ((responded || unloaded) && steady_contacts);
  unmet_ = unsteadiness(responded || unloaded);
  if (!steady) return RelaxationStatus::running;
  const GrainScales<Dim> scales(packing_, target_);
  const ForceScale& scale = scales.of_packing();
  const double limit =
      (coasting || (unloaded && steady_contacts) ? kMechanismEnergy : 1.0) * options_.tolerance.energy;
  const double energy = energy_of_connected_grains(packing_, scales);
  unmet_ = {Demand::rest, energy / (scale.force * scale.length), limit};
  if (energy < limit * scale.force * scale.length || vibrates(energy)) {
    unmet_ = {};
    progress_.phase = RelaxationProgress::finishing;
    progress_.finishing_since_phi = progress_.solid_fraction.back();
    if (load_.any_strained()) progress_.finishing_since_stress = mean_carried_stress();
    progress_.finishing_chunks = 0;
    progress_.next_refinement = 1;
    progress_.refused_within = 0;
  }
  return RelaxationStatus::running;
}

/// Returns the first criterion of a steady packing that the moving packing does not meet; Demand::none if all criteria
/// are met.
template <int Dim>
Unmet Relaxer<Dim>::unsteadiness(bool responded) const {
  if (!responded) return {Demand::response, residuals_.stress, options_.tolerance.stress};
  const auto range = [](const std::vector<double>& values) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return values.empty() ? 0.0 : *high - *low;
  };
  if (load_.unloaded()) return {Demand::contacts};
  if (const double moved = range(progress_.carried_stress) / stress_scale(); moved >= kSteadyStress)
    return {Demand::stress, moved, kSteadyStress};
  const double moved = range(progress_.solid_fraction);
  return moved >= kSteadyPhi ? Unmet{Demand::density, moved, kSteadyPhi} : Unmet{Demand::duration};
}

template <int Dim>
RelaxationStatus Relaxer<Dim>::check_finish() {
  unmet_ = {};
  ++progress_.finishing_chunks;
  // The final phase of the relaxation (power control and Newton steps) is only meant to remove the rest of the motion.
  // If the density or the stress changes by more than its limit, the packing has rearranged. The packing then moves
  // freely until its motion has stopped once more.
  const bool other_stress =
      load_.any_strained() &&
      std::abs(mean_carried_stress() - progress_.finishing_since_stress) > kFinishStress * stress_scale();
  if (other_stress || std::abs(solid_fraction(packing_) - progress_.finishing_since_phi) > kFinishPhi) {
    progress_.phase = RelaxationProgress::moving;
    progress_.solid_fraction.clear();
    progress_.carried_stress.clear();
    return RelaxationStatus::running;
  }
  // Newton steps are tried once the force residual is so small that they usually succeed. After a failure there is a
  // pause before the next attempt, because attempts may take longer than the dynamics. The pause grows with the time
  // since the beginning of power control.
  const bool within = residuals_.within(options_.tolerance);
  const bool may_refine = options_.finish != Finish::dynamic && residuals_.force < kRefinementResidual;
  const bool due = progress_.finishing_chunks >= progress_.next_refinement;
  if (may_refine && (due || (within && may_repeat_refinement()))) {
    if (newton_is_cheaper() && refine_by_newton()) return RelaxationStatus::converged;
    progress_.refused_within = within;
    progress_.next_refinement =
        progress_.finishing_chunks + std::max(kRefinementPause, progress_.finishing_chunks / 2);
  }
  // If the dynamics alone has brought the residuals below their tolerances, the state is an equilibrium if it is stable
  // and no liquid bridge changes.
  if (!within) return RelaxationStatus::running;
  Stability found;
  if (!is_stable(packing_, found) || !liquid_rests(packing_, true)) return RelaxationStatus::running;
  stability_ = std::move(found);
  ending_ = "dynamic";
  return RelaxationStatus::converged;
}

template <int Dim>
bool Relaxer<Dim>::is_stable(const Packing<Dim>& packing, Stability& found) {
  found = stability_at_rest(packing);
  if (!found.may_be_stable()) unmet_ = {Demand::stability, static_cast<double>(*found.n_negative)};
  return found.may_be_stable();
}

/// Whether Newton steps are expected to take at most as much computing time as the dynamics of this relaxation. The
/// time of the dynamics is the longer of two times: the time taken so far, and an estimate for the whole relaxation. In
/// 2D the function always returns true.
template <int Dim>
bool Relaxer<Dim>::newton_is_cheaper() const {
  if (Dim == 2) return true;
  const double steps = std::max(static_cast<double>(progress_.n_steps), kSettlingSteps);
  const double motion = steps * static_cast<double>(packing_.contacts.size()) * kSecondsPerContact;
  return plan_statics(packing_, BoundaryControl<Dim>::imposing(load_, target_, 0.0)).seconds <= motion;
}

/// Returns whether Newton refinement of a packing whose residuals are within tolerance may be tried at every check. In
/// 3D an attempt may take minutes. After a failure with residuals within tolerance, further attempts are therefore made
/// only after a pause. (If a packing is at rest on a saddle of the energy, every attempt fails.)
template <int Dim>
bool Relaxer<Dim>::may_repeat_refinement() const {
  return Dim == 2 || !progress_.refused_within;
}

template <int Dim>
bool Relaxer<Dim>::refine_by_newton() {
  return accept_if_equilibrium(solve_from(packing_, {}, StaticSolverOptions{}), "polished", true);
}

/// Solves the equations of static equilibrium under the load of this relaxation, starting from a packing.
/// @param ramp  strain ramp from the lengths of `start` to the imposed lengths; axes without a ramp keep their lengths
template <int Dim>
StaticSolution<Dim> Relaxer<Dim>::solve_from(const Packing<Dim>& start, const StrainRamp<Dim>& ramp,
                                             const StaticSolverOptions& options) const {
  auto control = BoundaryControl<Dim>::imposing(load_, target_, 0.0);
  control.ramp = ramp;
  return solve_statics(start, control, options);
}

/// Finds the equilibrium under a new load by Newton iterations without dynamics. The result is accepted only if
/// dynamics would end in the same state, or if the scene accepts any equilibrium.
template <int Dim>
bool Relaxer<Dim>::solve_without_motion() {
  const bool any = options_.finish == Finish::statics;
  // If the tangential stiffness depends on the load, the tangential forces depend on the whole loading path. Newton
  // steps may then give other forces than dynamics.
  if (!any && packing_.law.friction_follows_load()) return false;
  if (!any && !newton_is_cheaper()) return false;
  StaticSolverOptions trial;
  trial.max_iterations = kTrialIterations;
  StaticSolution<Dim> solution = solve_from(packing_, strain_ramp(), any ? StaticSolverOptions{} : trial);
  if (!any) {
    if (!solution.has_lengths || !is_elastic_step(packing_, solution.packing)) return false;
    // No spring has reached its cap, so the result does not depend on the configuration from which the remaining
    // iterations start.
    solution = solve_from(solution.packing, {}, StaticSolverOptions{});
    if (!is_elastic_step(packing_, solution.packing)) return false;
  }
  return accept_if_equilibrium(std::move(solution), "static", false);
}

/// Whether no liquid bridge of an equilibrium changes when the liquid is shared out once more. If bridges change and
/// `go_on` is set, the relaxation continues with the new volumes of the bridges. After kLiquidTrials continuations, the
/// present volumes are accepted.
template <int Dim>
bool Relaxer<Dim>::liquid_rests(const Packing<Dim>& equilibrium, bool go_on) {
  if (!holds_liquid(equilibrium)) return true;
  Packing<Dim> shared = equilibrium;
  const LiquidChange change = spread_liquid(shared);
  n_bridges_unsettled_ = change.n_changed();
  if (change.nothing() || progress_.liquid_trials >= kLiquidTrials) return true;
  unmet_ = {Demand::liquid, static_cast<double>(change.n_changed())};
  if (!go_on) return false;
  ++progress_.liquid_trials;
  packing_ = std::move(shared);
  measure();
  return false;
}

/// Accepts a static solution as the equilibrium if it is within tolerance and stable (docs/physics.md, "Equilibrium").
/// A static solution may be unstable: with a long-range adhesion, it may be a saddle of the energy, from which a grain
/// would roll onto its neighbour.
template <int Dim>
bool Relaxer<Dim>::accept_if_equilibrium(StaticSolution<Dim> solution, const char* ending, bool go_on) {
  if (!solution.converged) return false;
  const Mat<Dim> stress = static_stress(solution.packing);
  const Vec<Dim> target = load_.stress_with(stress);
  const Residuals reached = residuals(solution.packing, target, stress);
  if (!reached.within(options_.tolerance)) return false;
  Stability found;
  if (!is_stable(solution.packing, found) || !liquid_rests(solution.packing, go_on)) return false;
  packing_ = std::move(solution.packing);
  stress_ = stress;
  target_ = target;
  residuals_ = reached;
  stability_ = std::move(found);
  ending_ = ending;
  return true;
}

template <int Dim>
void Relaxer<Dim>::measure() {
  stress_ = static_stress(packing_);
  target_ = load_.stress_with(stress_);
  time_unit_ = inertial_time(packing_, target_);
  residuals_ = residuals(packing_, target_, stress_);
}

template <int Dim>
RelaxationReport Relaxer<Dim>::report() const {
  RelaxationReport report;
  report.residuals = residuals_;
  report.stability = stability_;
  report.n_bridges_unsettled = n_bridges_unsettled_;
  report.ending = ending_;
  report.phase = progress_.phase == RelaxationProgress::finishing ? "finishing" : "moving";
  report.time = progress_.time;
  report.n_steps = progress_.n_steps;
  report.blocking = worst_residual(residuals_, options_.tolerance, packing_.grains.id);
  const bool by_force = !(residuals_.force < options_.tolerance.force);
  if (report.blocking.empty()) report.blocking = in_words(unmet_);
  if (report.blocking.empty()) report.blocking = "all residuals are within their tolerances";
  if (ending_ == "diverged") report.blocking = kMotionDiverged;
  if (ending_ == "unloaded")
    report.blocking =
        "at the imposed lengths the packing carries no stress: every contact has opened (stress zero)";
  if (ending_ == "closed") report.blocking = overfilled_cell_error();
  const std::vector<double>& history = progress_.force_residual;
  if (by_force && history.size() > 1 && history.front() > 0.0 && history.back() > 0.0)
    report.decay_rate = std::log(history.front() / history.back()) /
                        (static_cast<double>(history.size() - 1) * kStepsPerChunk * time_step_);
  return report;
}

#define FLOC_INSTANTIATE(Dim)                                                                      \
  template double inertial_time(const Packing<Dim>&, const Vec<Dim>&);                             \
  template double strain_rate_cap(const RelaxationOptions&, const Packing<Dim>&, const Vec<Dim>&); \
  template class Relaxer<Dim>;
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
