#include "floc/relaxation/box_relaxer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floc/base/error.h"
#include "floc/elasticity/stability.h"
#include "floc/neighbors/find_contacts.h"
#include "floc/packing/balance.h"
#include "floc/packing/grain_sizes.h"
#include "floc/packing/law/contact_energy.h"
#include "floc/packing/least_mechanisms.h"
#include "floc/packing/wall_forces.h"
#include "floc/relaxation/dynamics.h"
#include "floc/relaxation/members_as_json.h"
#include "floc/relaxation/relaxer.h"

namespace floc {
namespace {

/// Largest change of the void ratio during the final phase of a relaxation (power control). If the void ratio changes
/// by more than this number, the packing moves freely again.
constexpr double kFinishVoidRatio = 1e-3;
/// Longest duration of the final phase of a relaxation (power control), in time units T (compaction_time()). If the
/// scene accepts states that are not equilibria, the state after this duration is recorded as it is.
constexpr double kLongestFinish = 60.0;
/// Two walls that no grain touches count as lost if their distance, divided by their initial distance, is above this
/// number.
constexpr double kLargestExpansion = 4.0;
/// A box counts as closed if the distance between two walls, divided by the largest diameter, is below this number.
/// Overlaps are small, so grains do not fit into a smaller box.
constexpr double kBoxClosed = 0.5;

/// Function that calls visit(name, member) for every member of a CompactionProgress, with the name that the member has
/// in checkpoints.
constexpr auto kBoxMembers = [](auto& p, const auto& visit) {
  visit("stage", p.phase);
  visit("n_steps", p.n_steps);
  visit("time", p.time);
  visit("skin", p.skin);
  visit("start_side", p.start_side);
  visit("void_ratio", p.void_ratio);
  visit("closing_sign", p.closing_sign);
  visit("armed", p.armed);
  visit("finishing_since", p.finishing_since);
  visit("finishing_time", p.finishing_time);
};

CompactionProgress parsed(const std::string& text) {
  if (text.empty()) return {};
  return members_from_json<CompactionProgress>(text, "progress",
                                               "the text does not contain the progress of a compaction between "
                                               "walls in the format of this version of floc",
                                               kBoxMembers);
}

/// Returns twice the height of the centre of mass of the grains above the floor (length). A homogeneous bed of this
/// height would have the same centre of mass.
template <int Dim>
double height_of_bed(const Packing<Dim>& packing, const Wall<Dim>& floor) {
  const Grains<Dim>& g = packing.grains;
  double sum = 0.0;
  for (int i = 0; i < g.size(); ++i) sum += g.mass[i] * (g.position[i][floor.axis] - floor.position);
  return 2.0 * sum / total_mass(g);
}

/// Returns the void ratio of a packing. A bed with a free surface counts as a homogeneous bed with the same centre of
/// mass, so that single grains high above the bed have little influence.
template <int Dim>
double void_ratio(const Packing<Dim>& packing) {
  double volume = packing.cell.volume();
  for (std::size_t w = 0; w + 1 < packing.walls.size(); w += 2) {
    const Wall<Dim>&floor = packing.walls[w], &above = packing.walls[w + 1];
    if (above.open) volume *= height_of_bed(packing, floor) / packing.cell.matrix(above.axis, above.axis);
  }
  return volume / total_volume(packing.grains) - 1.0;
}

/// Whether the upward forces of the walls on the grains add up to at least half of the weight of the grains.
template <int Dim>
bool walls_bear_weight(const Packing<Dim>& packing) {
  if (packing.gravity.isZero(0.0)) return true;
  const Vec<Dim> up = -packing.gravity.normalized();
  const double weight = total_mass(packing.grains) * packing.gravity.norm();
  double borne = 0.0;
  for (const Contact<Dim>& c : packing.contacts)
    if (packing.is_wall(c.j)) borne += up.dot(c.shear_force - c.normal_force * c.normal);
  return borne >= 0.5 * weight;
}

}  // namespace

template <int Dim>
double compaction_time(const Packing<Dim>& packing, double pressure) {
  if (!(pressure > 0.0)) return inertial_time<Dim>(packing, Vec<Dim>::Zero());
  const Grains<Dim>& g = packing.grains;
  return std::sqrt(largest_mass(g) / (pressure * std::pow(largest_diameter(g), Dim - 2)));
}

template <int Dim>
BoxRelaxer<Dim>::BoxRelaxer(const RelaxationOptions& options, Packing<Dim> packing, const LoadTarget<Dim>& load,
                            const std::string& progress)
    : options_(options),
      packing_(std::move(packing)),
      target_(load.stress),
      progress_(parsed(progress)),
      time_step_(time_step_of(packing_, options.time_step, target_.mean())),
      time_unit_(compaction_time(packing_, target_.mean())) {
  if (load.any_strained())
    throw InputError(
        "packing",
        "the load imposes a length on an axis, but a packing with walls needs a pressure on every axis");
  measure();
  if (progress_.skin == 0.0)
    progress_.skin = options.skin ? *options.skin * largest_diameter(packing_.grains)
                                  : 0.05 * skin_length_unit(packing_.grains.radius);
  if (!progress_.start_side.empty()) return;
  const Vec<Dim> pressure = wall_pressure(packing_);
  for (int a = 0; a < Dim; ++a) {
    progress_.start_side.push_back(packing_.cell.matrix(a, a));
    const bool closes = options.compaction.wall_speed && n_moving_walls(packing_, a) > 0;
    progress_.closing_sign.push_back(!closes ? 0.0 : pressure[a] < target_[a] ? -1.0 : 1.0);
  }
}

/// Returns the control of the walls for the next chunk of time steps. Axes whose walls still move at the speed given by
/// the scene have an imposed strain rate. All other axes have the imposed pressure. Walls of infinite mass stay at
/// rest.
template <int Dim>
BoundaryControl<Dim> BoxRelaxer<Dim>::control() {
  BoundaryControl<Dim> control = BoundaryControl<Dim>::fixed();
  const Vec<Dim> pressure = wall_pressure(packing_);
  for (int a = 0; a < Dim; ++a) {
    if (!between_walls(packing_.walls, a)) continue;
    double& sign = progress_.closing_sign[a];
    if ((pressure[a] - target_[a]) * sign < 0.0) sign = 0.0;
    control.imposed[a] = sign == 0.0 ? Imposed::stress : Imposed::rate;
    control.target[a] =
        sign == 0.0 ? target_[a] : -sign * *options_.compaction.wall_speed / packing_.cell.matrix(a, a);
  }
  return control;
}

template <int Dim>
RelaxationStatus BoxRelaxer<Dim>::advance() {
  time_step_ = time_step_of(packing_, options_.time_step, target_.mean());
  const bool finishing = progress_.phase == CompactionProgress::finishing;
  auto dynamics = make_dynamics(packing_, control(), {time_step_, progress_.skin, options_.threads});
  advance_observed(*dynamics, kStepsPerChunk, finishing ? Motion::power_control : Motion::free, observer_,
                   progress_.time, time_step_);
  if (!dynamics->finite()) {
    // The packing is unchanged since the beginning of the chunk of time steps, except that its contacts were moved into
    // the object `dynamics`. The contacts have to be found again.
    find_contacts(packing_);
    measure();
    return give_up(
        "diverged",
        "the motion diverged: run.time_step is too large, or box.mass is too small for this time step");
  }
  // The old packing is freed first, so that a large packing is not stored twice.
  packing_ = {};
  packing_ = dynamics->release_packing();
  if (!options_.skin) progress_.skin = dynamics->skin();
  dynamics.reset();
  fit_open_ends(packing_);
  progress_.n_steps += kStepsPerChunk;
  progress_.time += kStepsPerChunk * time_step_;
  measure();
  if (std::string words = lost(); !words.empty()) return give_up("lost", std::move(words));
  const RelaxationStatus status = finishing ? check_finish() : check_motion();
  if (status != RelaxationStatus::running) return status;
  // If the scene sets a longest time, the state at that time is recorded as it is. If the final phase of the relaxation
  // (power control) has begun before that time, this phase continues for the duration that check_finish() allows.
  if (options_.compaction.longest) {
    if (finishing || progress_.time <= *options_.compaction.longest * time_unit_) return status;
    return stop_here();
  }
  if (progress_.time <= options_.max_time * time_unit_) return status;
  std::string blocking = in_words(unmet_);
  if (blocking.empty()) blocking = worst_residual(residuals_, options_.tolerance, packing_.grains.id);
  return give_up("", fmt::format("the box has not settled within equilibrium.max_time = {:g}: {}",
                                 options_.max_time, blocking));
}

/// Whether the scene accepts a state that is not an equilibrium.
template <int Dim>
bool BoxRelaxer<Dim>::may_stop() const {
  return options_.compaction.longest || options_.compaction.criterion == CompactionEnd::Criterion::energy_ratio;
}

template <int Dim>
RelaxationStatus BoxRelaxer<Dim>::give_up(const char* ending, std::string words) {
  ending_ = ending;
  words_ = std::move(words);
  return RelaxationStatus::gave_up;
}

/// Returns the reason why grains and walls no longer form a packing; empty if they still form a packing.
template <int Dim>
std::string BoxRelaxer<Dim>::lost() const {
  const Grains<Dim>& g = packing_.grains;
  // A grain whose centre has passed a wall overlaps the wall by more than its radius, which no contact law describes.
  for (const Wall<Dim>& wall : packing_.walls)
    for (int i = 0; i < g.size() && !wall.open; ++i)
      if (!(wall.side * (wall.position - g.position[i][wall.axis]) > 0.0))
        return fmt::format(
            "grain {} has its centre on or beyond a wall of axis {}: the walls move too fast, or the "
            "pressure is too high for the stiffness of the grains",
            g.name(i), wall.axis + 1);
  const double a = largest_diameter(g);
  const std::vector<double> force = wall_forces(packing_);
  // Forces and pressures move the walls. If the grains cannot resist the pressure, the walls close the box. If no grain
  // touches the walls, the walls may move apart without end.
  for (std::size_t w = 0; w < packing_.walls.size(); ++w) {
    const int axis = packing_.walls[w].axis;
    const double side = packing_.cell.matrix(axis, axis);
    if (side < kBoxClosed * a)
      return fmt::format(
          "the box closes: its walls across axis {} are {:.4g} apart, which is too close for the grains "
          "between them, whose largest diameter is {:.4g}",
          axis + 1, side, a);
    if (follows_forces(packing_.walls[w]) && force[w] == 0.0 &&
        side > kLargestExpansion * progress_.start_side[axis])
      return fmt::format(
          "the walls across axis {} move apart without end: their distance is {:.4g} (at the beginning {:.4g}) "
          "and no grain touches them; choose a higher pressure, or slower grains at the beginning",
          axis + 1, side, progress_.start_side[axis]);
  }
  return "";
}

/// Whether at some time the pressure of the grains on each wall was at least half of the imposed pressure and, with
/// gravity, the walls supported at least half of the weight. A compaction cannot end before that time.
template <int Dim>
bool BoxRelaxer<Dim>::is_armed() {
  if (progress_.armed) return true;
  const std::vector<double> force = wall_forces(packing_);
  bool all = walls_bear_weight(packing_);
  for (std::size_t w = 0; w < force.size(); ++w) {
    const Wall<Dim>& wall = packing_.walls[w];
    if (!follows_forces(wall)) continue;
    const double load = target_[wall.axis] * wall_area(packing_, wall.axis);
    all = all && force[w] >= 0.5 * load;
  }
  for (const double sign : progress_.closing_sign) all = all && sign == 0.0;
  return progress_.armed = all;
}

/// Whether the void ratio has been steady for the time that [SVI2024] requires (docs/physics.md, "Boxes with walls").
template <int Dim>
bool BoxRelaxer<Dim>::void_ratio_is_steady() {
  std::vector<double>& recent = progress_.void_ratio;
  recent.push_back(void_ratio(packing_));
  const double chunk = kStepsPerChunk * time_step_;
  const auto window = static_cast<std::size_t>(
                          std::ceil(options_.patience * CompactionEnd::kSettledTime * time_unit_ / chunk)) +
                      1;
  if (recent.size() > window) recent.erase(recent.begin(), recent.end() - static_cast<std::ptrdiff_t>(window));
  const auto [least, most] = std::minmax_element(recent.begin(), recent.end());
  const bool steady = *most - *least < CompactionEnd::kSettledVoidRatio;
  unmet_ = steady ? Unmet{Demand::duration}
                  : Unmet{Demand::density, *most - *least, CompactionEnd::kSettledVoidRatio};
  return steady && recent.size() >= window;
}

template <int Dim>
bool BoxRelaxer<Dim>::has_ended() {
  const bool steady = void_ratio_is_steady();
  if (!is_armed()) {
    unmet_ = {Demand::wall_load};
    return false;
  }
  if (options_.compaction.criterion == CompactionEnd::Criterion::energy_ratio) {
    unmet_ = {Demand::energy_ratio, energy_ratio_, options_.compaction.energy_ratio};
    return energy_ratio_ <= options_.compaction.energy_ratio;
  }
  if (steady) unmet_ = {Demand::pressure, residuals_.stress, CompactionEnd::kSettledPressure};
  return steady && residuals_.stress < CompactionEnd::kSettledPressure;
}

/// Begins the final phase of the relaxation (power control) once the compaction has ended and no mechanism is left. A
/// packing with mechanisms (motions without stiffness) first moves on until more contacts support it: power control
/// would stop the motion too early. If the ratio of energies ends the compaction, a state with mechanisms is recorded
/// as it is.
template <int Dim>
RelaxationStatus BoxRelaxer<Dim>::check_motion() {
  if (!has_ended()) return RelaxationStatus::running;
  const bool by_energy = options_.compaction.criterion == CompactionEnd::Criterion::energy_ratio;
  n_mechanisms_ = least_mechanisms(packing_);
  if (n_mechanisms_ > 0 && by_energy) return stop_here();
  unmet_ = {Demand::mechanisms, static_cast<double>(n_mechanisms_)};
  if (n_mechanisms_ > 0) return RelaxationStatus::running;
  unmet_ = {};
  progress_.phase = CompactionProgress::finishing;
  progress_.finishing_since = void_ratio(packing_);
  progress_.finishing_time = progress_.time;
  return RelaxationStatus::running;
}

template <int Dim>
RelaxationStatus BoxRelaxer<Dim>::check_finish() {
  stability_ = {};
  unmet_ = {};
  if (std::abs(void_ratio(packing_) - progress_.finishing_since) > kFinishVoidRatio) {
    progress_.phase = CompactionProgress::moving;
    progress_.void_ratio.clear();
    return RelaxationStatus::running;
  }
  if (residuals_.within(options_.tolerance)) {
    stability_ = stability_at_rest(packing_);
    if (!stability_.may_be_stable()) {
      unmet_ = {Demand::stability, static_cast<double>(*stability_.n_negative)};
    } else if (const LiquidChange change = share_liquid_once_more(); !change.nothing()) {
      // Sharing out the liquid once more would change bridges, so the packing is not yet in equilibrium.
      unmet_ = {Demand::liquid, static_cast<double>(change.n_changed())};
    } else {
      n_mechanisms_ = least_mechanisms(packing_);
      ending_ = "dynamic";
      return RelaxationStatus::converged;
    }
  }
  const bool long_enough = progress_.time - progress_.finishing_time > kLongestFinish * time_unit_;
  return long_enough && may_stop() ? stop_here() : RelaxationStatus::running;
}

/// Returns how the liquid bridges would change if the liquid were shared out once more among the pairs of grains. The
/// packing itself is not changed. Without liquid, all changes are zero.
template <int Dim>
LiquidChange BoxRelaxer<Dim>::share_liquid_once_more() {
  if (!holds_liquid(packing_)) return {};
  Packing<Dim> shared = packing_;
  const LiquidChange change = spread_liquid(shared);
  n_bridges_unsettled_ = change.n_changed();
  return change;
}

/// Ends the relaxation with the present state, which need not be an equilibrium. The report contains the stability of
/// this state if check_finish() has determined the stability.
template <int Dim>
RelaxationStatus BoxRelaxer<Dim>::stop_here() {
  n_mechanisms_ = least_mechanisms(packing_);
  (void)share_liquid_once_more();
  ending_ = "stopped";
  return RelaxationStatus::converged;
}

template <int Dim>
void BoxRelaxer<Dim>::measure() {
  stress_ = static_stress(packing_);
  residuals_ = residuals(packing_, target_, stress_);
  energy_ratio_ = kinetic_over_elastic_energy(packing_);
}

template <int Dim>
RelaxationReport BoxRelaxer<Dim>::report() const {
  RelaxationReport report;
  report.residuals = residuals_;
  report.stability = stability_;
  report.n_mechanisms = n_mechanisms_;
  report.n_bridges_unsettled = n_bridges_unsettled_;
  report.ending = ending_;
  report.phase = progress_.phase == CompactionProgress::finishing ? "finishing" : "moving";
  report.time = progress_.time;
  report.n_steps = progress_.n_steps;
  report.blocking =
      words_.empty()
          ? fmt::format(
                "t = {:.1f} T, ratio of kinetic to elastic energy {:.1e}, relative error of the wall pressures "
                "{:.1e}, force residual {:.1e}",
                progress_.time / time_unit_, energy_ratio_, residuals_.stress, residuals_.force)
          : words_;
  return report;
}

template <int Dim>
std::string BoxRelaxer<Dim>::progress() const {
  return members_as_json(progress_, kBoxMembers);
}

template class BoxRelaxer<2>;
template class BoxRelaxer<3>;
template double compaction_time(const Packing<2>&, double);
template double compaction_time(const Packing<3>&, double);

}  // namespace floc
