#include "floc/relaxation/contact_dynamics_relaxer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "floc/base/error.h"
#include "floc/contact/law_parameters.h"
#include "floc/packing/balance.h"
#include "floc/packing/grain_sizes.h"
#include "floc/packing/locate.h"
#include "floc/packing/wall_forces.h"
#include "floc/packing/wrap.h"
#include "floc/relaxation/members_as_json.h"
#include "floc/relaxation/relaxer.h"

namespace floc {
namespace {

/// Number of successive calm steps after which the motion counts as ended. A calm step meets two conditions. The root
/// mean square velocity is below kCalmVelocity d/T, with the largest diameter d and the time unit T. The strain rate of
/// the cell is below kCalmRate times its cap. The relative error of the stress is then below kCalmRate, too.
constexpr int kCalmSteps = 40;
constexpr double kCalmRate = 0.03;
constexpr double kCalmVelocity = 6e-3;
/// Factor by which kCalmRate and kCalmVelocity are larger for frictionless polyhedra, whose motion decays slowly
/// because contact switches back and forth between corners. Three packings of 300 took 83 to 142 s with a factor of 3.
/// With 8 and with 1.5, one of them found no minimum in 240 s.
constexpr double kJitter = 3.0;
/// Elastic grains with corners have to be calmer by the factor kCalmerOnSprings, or calm for kPatientSteps steps. If the
/// springs change much in a time step, Newton steps rearrange the grains, and are far more expensive than sweeps: two
/// packings of 300 polyhedra (K_N = 1e5 P a) were at rest after 75 and 90 s, in place of more than 10 minutes.
constexpr double kCalmerOnSprings = 0.05;
constexpr int kPatientSteps = 4000;
/// Impacts are inelastic if the rate of approach, in units of a dt/T^2, is below this number. Here a is the largest
/// diameter, dt the time step and T the time unit. The unit a dt/T^2 is the velocity that the pressure gives to a grain
/// in one time step.
constexpr double kSlowImpact = 2.0;
/// Factor by which the tolerance of the sweeps is larger while the packing counts as a gas.
constexpr double kGasTolerance = 10.0;
/// A packing counts as a gas if its mean stress, divided by the mean imposed stress, is below this number. In a box, the
/// sum of the forces on the walls takes the place of the stress, and the load on moving walls and the weight of the grains
/// that of the imposed stress.
constexpr double kGasStress = 0.3;
/// Number of steps of the phase `resting` that are solved by sweeps. In later steps, all contacts are solved at once.
/// In 2D such a step costs as much as a few hundred sweeps, but it brings creeping polygons to rest. In 3D it costs far
/// more. Round grains come to rest by sweeps. In a test, disks came to rest by sweeps within 15 s; when all contacts
/// were solved at once, gaps stayed above the tolerance for minutes.
template <int Dim>
int swept_steps(bool are_round) {
  return Dim == 2 && !are_round ? 400 : 2600;
}
/// Largest number of grains for which contacts are solved all at once. For frictionless grains with corners there is no
/// limit.
constexpr int kMostGrainsAtOnce = 1000;
/// Longest time step, in units of T, if contacts are solved all at once.
constexpr double kLongestAtOnce = 3.0;
/// Largest imposed strain of elastic grains, divided by strain_of_springs(), during which all contacts are solved at
/// once. Larger strains open many contacts, and the grains have to move.
constexpr double kElasticStrains = 1.0;
/// Tolerance of the impulses in the phase `resting`, divided by the mean normal impulse: the sweeps of a step end when
/// the error is below this tolerance.
constexpr double kRestingTolerance = 1e-8;
/// Largest number of sweeps in a time step of the phase `resting`.
constexpr int kRestingSweeps = 300;

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
  visit("n_rests", p.n_rests);
  visit("least_residual", p.least_residual);
  visit("least_at", p.least_at);
  visit("tried_residual", p.tried_residual);
  visit("next_trial", p.next_trial);
  visit("rest_length", p.rest_length);
  visit("side_before", p.side_before);
  visit("offset_before", p.offset_before);
  visit("obstacle", p.obstacle);
};

/// Returns the order of magnitude of the strain that a stress causes in a packing with linear springs: P a^(Dim-2)/K_N,
/// with the mean stress P, the largest diameter a and the normal stiffness K_N.
template <int Dim>
double strain_of_springs(const Packing<Dim>& packing, const Vec<Dim>& stress) {
  const double stiffness = packing.law.parameters().normal.template get<LinearRepulsion>().normal_stiffness;
  return stress.mean() * std::pow(largest_diameter(packing.grains), Dim - 2) / stiffness;
}

template <int Dim>
bool is_at_rest(const Packing<Dim>& packing) {
  return packing.cell.velocity.isZero(0.0) &&
         std::ranges::all_of(packing.walls, [](const Wall<Dim>& wall) { return wall.velocity == 0.0; }) &&
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
  strain_rate_ = is_elastic() ? strain_rate_cap(options_, packing_, imposed_)
                              : options_.contact_dynamics.inertial_number / time_unit_;
  if (progress.empty()) begin_strain();
  strains_springs_ =
      is_elastic() && imposed_strain().size() <= kElasticStrains * strain_of_springs(packing_, imposed_);
  measure();
  // A packing at rest that bears load begins with the phase `resting`: the errors of the sweeps of a motion would make
  // contacts slip that do not slip under the load.
  if (progress.empty() && is_elastic() && progress_.phase == ContactDynamicsProgress::moving &&
      is_at_rest(packing_) && !is_gas())
    start_resting();
}

/// Returns whether the contacts of a step are solved all at once. For elastic grains this holds in the phase `resting`
/// and during small strains, because the errors of sweeps would make contacts slip that do not slip under the load. For
/// rigid grains it holds only in the phase `resting`: for frictionless grains with corners from the start of this
/// phase, for other packings after swept_steps() steps if there are at most kMostGrainsAtOnce grains.
template <int Dim>
bool ContactDynamicsRelaxer<Dim>::solves_at_once() const {
  if (progress_.phase == ContactDynamicsProgress::straining) return strains_springs_;
  if (progress_.phase != ContactDynamicsProgress::resting) return false;
  if (is_elastic()) return true;
  const Grains<Dim>& grains = packing_.grains;
  const bool frictionless = packing_.law.friction_coefficient() == 0.0;
  return (frictionless && !grains.are_round()) ||
         (progress_.resting_steps >= swept_steps<Dim>(grains.are_round()) &&
          grains.size() <= kMostGrainsAtOnce);
}

template <int Dim>
ContactDynamicsSettings ContactDynamicsRelaxer<Dim>::settings() const {
  const ContactDynamicsOptions& own = options_.contact_dynamics;
  const bool resting = progress_.phase == ContactDynamicsProgress::resting;
  const double longest = !resting                            ? own.time_step
                         : solves_at_once() && !is_elastic() ? kLongestAtOnce
                                                             : progress_.rest_length;
  return {.longest_step = longest * time_unit_,
          .sweep_tolerance = resting ? std::min(kRestingTolerance, own.sweep_tolerance)
                                     : (is_gas() ? kGasTolerance : 1.0) * own.sweep_tolerance,
          .max_sweeps = resting ? kRestingSweeps : own.max_sweeps,
          .restitution = resting ? 0.0 : own.restitution,
          .slow_impact = kSlowImpact * own.time_step * largest_diameter(packing_.grains) / time_unit_,
          .threads = options_.threads,
          .at_once = solves_at_once()};
}

template <int Dim>
BoundaryLoad<Dim> ContactDynamicsRelaxer<Dim>::boundary_load() const {
  BoundaryLoad<Dim> load;
  load.stress = imposed_;
  // In a box, periodic axes keep their lengths.
  for (int a = 0; a < Dim; ++a) load.under_stress[a] = packing_.walls.empty() && !load_.strained(a);
  load.cell_mass = options_.cell_mass;
  // A cap on the strain rate acts on the walls like a mass that is larger than the mass of all grains, and sweeps then
  // converge slowly. In the phase `resting` the cap is not needed.
  if (!packing_.walls.empty() && progress_.phase == ContactDynamicsProgress::resting) return load;
  load.wall_speed = options_.compaction.wall_speed;
  // While the cell is strained, its strain rate has no cap. The drag that caps the strain rate would balance a part of
  // the stress on growing sides.
  if (progress_.phase != ContactDynamicsProgress::straining)
    load.strain_rate_cap = strain_rate_cap(options_, packing_, imposed_);
  return load;
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

/// Returns whether the mean stress of a packing, or the sum of the forces on the walls of a box, is so small that the
/// packing counts as a gas. Such a packing may be calm, because a heavy cell, heavy walls or weak gravity have not moved
/// it yet.
template <int Dim>
bool ContactDynamicsRelaxer<Dim>::is_gas() const {
  if (packing_.walls.empty()) return stress_.trace() < kGasStress * imposed_.sum();
  const std::vector<double> force = wall_forces(packing_);
  double load = packing_.gravity.norm() * total_mass(packing_.grains);
  for (const Wall<Dim>& wall : packing_.walls)
    if (follows_forces(wall)) load += imposed_[wall.axis] * wall_area(packing_, wall.axis);
  return std::accumulate(force.begin(), force.end(), 0.0) < kGasStress * load;
}

/// Returns whether the motion of the packing has nearly ended. The balance of the stress is judged by the strain rate
/// of the cell. This rate is proportional to the difference between the stress and the imposed stress, and the errors
/// of single impulses cancel in the strain rate.
/// @param factor  factor by which the largest allowed velocity and strain rate are multiplied
template <int Dim>
bool ContactDynamicsRelaxer<Dim>::is_calm(const Packing<Dim>& packing, double factor) const {
  const double jitter = factor * (are_smooth_polyhedra(packing) ? kJitter : 1.0);
  const double velocity = jitter * kCalmVelocity * largest_diameter(packing.grains) / time_unit_;
  return rms_velocity(packing.grains) < velocity &&
         boundary_rate(packing) < jitter * kCalmRate * rate_cap(packing);
}

/// Returns whether the motion has been calm for so long that the phase `resting` begins.
template <int Dim>
bool ContactDynamicsRelaxer<Dim>::motion_has_ended() const {
  if (progress_.calm_steps < kCalmSteps || is_gas()) return false;
  const bool waits = is_elastic() && !packing_.grains.are_round() && progress_.calm_steps < kPatientSteps;
  return !waits || is_calm(packing_, kCalmerOnSprings);
}

/// Makes time steps and then moves the grains into the cell, so that an interrupted relaxation continues from identical
/// positions.
template <int Dim>
void ContactDynamicsRelaxer<Dim>::make_steps(int n_steps) {
  const ContactDynamicsSettings chosen = settings();
  const double first =
      progress_.time_step > 0.0 ? std::min(progress_.time_step, chosen.longest_step) : chosen.longest_step;
  const bool at_rest = progress_.phase == ContactDynamicsProgress::resting;
  const bool stops = at_rest && (!chosen.at_once || is_elastic());
  ContactDynamics<Dim> motion(std::move(packing_), boundary_load(), chosen, first, progress_.last_step);
  for (int k = 0; k < n_steps; ++k) {
    if (progress_.phase == ContactDynamicsProgress::straining && !impose_strain(motion)) break;
    motion.step(stops);
    // Steps of the phase `resting` do not count as simulated time.
    if (!at_rest) progress_.time += motion.last_step();
    progress_.calm_steps = is_calm(motion.packing(), 1.0) ? progress_.calm_steps + 1 : 0;
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
  if (motion_has_ended()) start_resting();
  return progress_.time > options_.max_time * time_unit_ ? RelaxationStatus::gave_up
                                                         : RelaxationStatus::running;
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
  if (resting) report.n_resting_steps = progress_.resting_steps;
  report.counts = {progress_.n_steps, progress_.n_sweeps, progress_.n_unfinished, progress_.deepest_overlap};
  if (ending_ == "closed") report.blocking = closed_cell();
  if (!ending_.empty()) return report;
  if (progress_.phase == ContactDynamicsProgress::straining)
    report.blocking = "the imposed strain is not reached yet";
  else if (resting)
    report.blocking =
        progress_.obstacle.empty() ? "the net forces on the grains are not small yet" : progress_.obstacle;
  else {
    report.blocking = fmt::format(
        "the grains still move: their root mean square velocity is {:.2g} of the largest diameter per time "
        "unit T, and the largest strain rate of the {} is {:.2g} per T",
        rms_velocity(packing_.grains) * time_unit_ / largest_diameter(packing_.grains),
        packing_.walls.empty() ? "cell" : "box", boundary_rate(packing_) * time_unit_);
    if (!progress_.obstacle.empty())
      report.blocking += fmt::format("; the last search for an equilibrium failed: {}", progress_.obstacle);
  }
  return report;
}

template <int Dim>
std::string ContactDynamicsRelaxer<Dim>::progress() const {
  return members_as_json(progress_, kMembers);
}

template class ContactDynamicsRelaxer<2>;
template class ContactDynamicsRelaxer<3>;

}  // namespace floc
