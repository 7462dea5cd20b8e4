#include "floc/relaxation/soft_relaxer.h"

#include <algorithm>
#include <cmath>

#include "floc/base/error.h"
#include "floc/contact/softened_law.h"
#include "floc/packing/balance.h"
#include "floc/packing/grain_sizes.h"
#include "floc/relaxation/dynamics.h"
#include "floc/relaxation/members_as_json.h"
#include "floc/relaxation/softening.h"

namespace floc {
namespace {

/// Largest factor by which the stiffness increases in one step of the stage `restoring`.
constexpr double kLevelRatio = 4.0;
/// Number of time steps under power control after each step of the stage `restoring`.
constexpr int kStepsOfLevel = 500;
/// Skin of the neighbour lists in the stage `restoring`, in units of skin_length_unit(), which is the largest diameter
/// or, if grains differ much in size, the smallest diameter.
constexpr double kSkin = 0.02;
/// A packing is judged to collapse if the relative change of its solid fraction exceeds kCollapse + kElasticStrains
/// times the mean relative overlap of its contacts. The second term allows for elastic strains, which are proportional
/// to the overlaps.
constexpr double kCollapse = 1e-3;
constexpr double kElasticStrains = 10.0;
/// Largest number of collapses on soft springs in one relaxation. Later collapses happen with the springs of the
/// contact law.
constexpr int kMostCollapses = 8;

/// Function that calls visit(name, member) for every member of a SoftProgress, with the name that the member has in
/// checkpoints.
constexpr auto kSoftMembers = [](auto& p, const auto& visit) {
  visit("soft_stage", p.stage);
  visit("level", p.level);
  visit("n_collapses", p.n_collapses);
  visit("begun_phi", p.begun_phi);
  visit("n_steps", p.n_steps);
  visit("time", p.time);
  visit("relaxation", p.relaxation);
};

SoftProgress soft_progress(const std::string& text) {
  if (text.empty()) return {};
  return members_from_json<SoftProgress>(text, "progress",
                                         "the text does not contain the progress of a relaxation with soft "
                                         "springs in the format of this version of floc",
                                         kSoftMembers);
}

/// Returns the mean overlap of the contacts of a packing, divided by the mean distance of two touching centres (the sum
/// of the radii).
template <int Dim>
double mean_overlap(const Packing<Dim>& packing) {
  double overlap = 0.0, distance = 0.0;
  for (const Contact<Dim>& c : packing.contacts) {
    overlap += std::max(-c.gap, 0.0);
    distance += packing.grains.radius[c.i] + packing.grains.radius[c.j];
  }
  return distance > 0.0 ? overlap / distance : 0.0;
}

}  // namespace

std::string progress_on_soft_springs() {
  SoftProgress progress;
  progress.stage = SoftProgress::moving;
  progress.n_collapses = 1;
  return members_as_json(progress, kSoftMembers);
}

template <int Dim>
SoftRelaxer<Dim>::SoftRelaxer(const RelaxationOptions& options, Packing<Dim> packing,
                              const LoadTarget<Dim>& load, const std::string& progress)
    : options_(options),
      packing_(std::move(packing)),
      load_(load),
      progress_(soft_progress(progress)),
      law_(packing_.law) {
  if (load.any_strained() || load.offset)
    throw InputError("softening",
                     "springs can be softened only where a stress is imposed on every axis of the cell");
  const std::string fault =
      softening_limit(law_, Dim, largest_diameter(packing_.grains), load.stress.maxCoeff())
          .fault(options.softening);
  if (!fault.empty()) throw InputError("softening", fault);
  if (progress.empty() && packing_.contacts.empty())
    soften();
  else if (progress.empty())
    enter(SoftProgress::stiff);
  keep(relaxer());
}

/// Returns the number of steps in which the springs regain the stiffness of the contact law.
template <int Dim>
int SoftRelaxer<Dim>::n_levels() const {
  return std::max(1, static_cast<int>(std::ceil(std::log(options_.softening) / std::log(kLevelRatio))));
}

/// Returns the stiffness of the springs of the contact law, divided by the stiffness of the present springs.
template <int Dim>
double SoftRelaxer<Dim>::softening() const {
  if (progress_.stage == SoftProgress::stiff || progress_.level == n_levels()) return 1.0;
  if (progress_.level == 0) return options_.softening;
  return std::pow(options_.softening, 1.0 - static_cast<double>(progress_.level) / n_levels());
}

/// Makes a relaxer for the packing with its present springs, and moves the packing into the relaxer.
template <int Dim>
Relaxer<Dim> SoftRelaxer<Dim>::relaxer() {
  RelaxationProgress progress;
  if (!progress_.relaxation.empty()) {
    progress = relaxation_progress(progress_.relaxation);
  } else {
    progress.n_steps = progress_.n_steps;
    progress.time = progress_.time;
  }
  RelaxationOptions options = options_;
  if (progress_.stage != SoftProgress::stiff) {
    options.finish = Finish::dynamic;  // Newton steps would solve for an equilibrium of the soft springs
  } else if (progress_.n_collapses > 0 && progress_.relaxation.empty()) {
    // Power control removes the motion that is left after the springs have regained their stiffness.
    progress.phase = RelaxationProgress::finishing;
    progress.finishing_since_phi = progress_.begun_phi;
    progress.next_refinement = 1;
    progress.imbalance_sign.assign(Dim, 0.0);
  }
  soften_in_place(packing_, law_, 1.0, softening());
  Relaxer<Dim> out(options, std::move(packing_), load_, std::move(progress));
  out.set_observer(observer_);
  return out;
}

/// Takes the packing and the results back from a relaxer that was made by relaxer().
template <int Dim>
void SoftRelaxer<Dim>::keep(Relaxer<Dim> relaxer) {
  report_ = relaxer.report();
  stress_ = relaxer.stress();
  target_ = relaxer.target_stress();
  packing_ = relaxer.release_packing();
  soften_in_place(packing_, law_, softening(), 1.0);
}

template <int Dim>
void SoftRelaxer<Dim>::enter(SoftProgress::Stage stage) {
  progress_.stage = stage;
  progress_.level = 0;
  progress_.begun_phi = solid_fraction(packing_);
  progress_.relaxation.clear();
}

template <int Dim>
RelaxationStatus SoftRelaxer<Dim>::advance() {
  return progress_.stage == SoftProgress::restoring ? restore() : move();
}

/// Whether the density of a packing with the springs of its contact law has changed by more than elastic strains can
/// cause.
template <int Dim>
bool SoftRelaxer<Dim>::collapses() const {
  const double change = std::abs(solid_fraction(packing_) / progress_.begun_phi - 1.0);
  return change > kCollapse + kElasticStrains * mean_overlap(packing_);
}

/// Replaces the springs of the contact law by soft springs that carry the same forces.
template <int Dim>
void SoftRelaxer<Dim>::soften() {
  change_softening(packing_, law_, 1.0, options_.softening);
  soften_in_place(packing_, law_, options_.softening, 1.0);
  ++progress_.n_collapses;
  enter(SoftProgress::moving);
}

/// Makes the springs stiffer by one step of the stage `restoring`, and moves the packing until it has nearly come to
/// rest.
template <int Dim>
RelaxationStatus SoftRelaxer<Dim>::restore() {
  const double from = softening();
  ++progress_.level;
  const double to = softening();
  soften_in_place(packing_, law_, 1.0, from);
  change_softening(packing_, law_, from, to);
  const bool finite = come_to_rest();
  soften_in_place(packing_, law_, to, 1.0);
  if (!finite) return RelaxationStatus::gave_up;
  if (progress_.level == n_levels()) enter(SoftProgress::stiff);
  keep(relaxer());
  return RelaxationStatus::running;
}

/// Moves the packing with its present springs under power control.
/// @return false if the motion diverged
template <int Dim>
bool SoftRelaxer<Dim>::come_to_rest() {
  const Vec<Dim>& stress = load_.stress;
  const auto control = BoundaryControl<Dim>::normal_stress(
      stress, options_.cell_mass * total_mass(packing_.grains), strain_rate_cap(options_, packing_, stress));
  const double pressure = std::max(stress.mean(), 0.0);
  const double time_step = std::min(time_step_of(packing_, options_.time_step, pressure),
                                    cell_time_step_of(packing_, control.mass, options_.time_step, pressure));
  const double skin = options_.skin ? *options_.skin * largest_diameter(packing_.grains)
                                    : kSkin * skin_length_unit(packing_.grains.radius);
  auto dynamics = make_dynamics(packing_, control, {time_step, skin, options_.threads});
  advance_observed(*dynamics, kStepsOfLevel, Motion::power_control, observer_, progress_.time, time_step);
  if (!dynamics->finite()) {
    report_.ending = "diverged";
    report_.blocking = kMotionDiverged;
    return false;
  }
  packing_ = {};
  packing_ = dynamics->release_packing();
  progress_.n_steps += kStepsOfLevel;
  progress_.time += kStepsOfLevel * time_step;
  return true;
}

/// Advances the relaxation by a chunk of time steps in the stages `moving` and `stiff`. The stage `moving` ends when
/// the motion has stopped.
template <int Dim>
RelaxationStatus SoftRelaxer<Dim>::move() {
  Relaxer<Dim> moving = relaxer();
  const RelaxationStatus status = moving.advance();
  progress_.relaxation = moving.progress();
  progress_.n_steps = moving.report().n_steps;
  progress_.time = moving.report().time;
  const bool stopped = moving.has_stopped();
  keep(std::move(moving));
  if (status != RelaxationStatus::running) return status;
  if (progress_.stage == SoftProgress::moving) {
    if (stopped) enter(SoftProgress::restoring);
  } else if (!stopped && progress_.n_collapses < kMostCollapses && collapses()) {
    soften();
  }
  return status;
}

template <int Dim>
std::string SoftRelaxer<Dim>::progress() const {
  return members_as_json(progress_, kSoftMembers);
}

template class SoftRelaxer<2>;
template class SoftRelaxer<3>;

}  // namespace floc
