#include "floc/loading/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "floc/assembly/random_streams.h"
#include "floc/assembly/shaped_gas.h"
#include "floc/base/error.h"
#include "floc/base/range.h"
#include "floc/base/version.h"
#include "floc/neighbors/find_contacts.h"
#include "floc/neighbors/spread_liquid.h"
#include "floc/packing/grain_sizes.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/packing/reduce_tilt.h"
#include "floc/relaxation/relaxer.h"
#include "floc/relaxation/soft_relaxer.h"

namespace floc {
namespace {

/// Gives the walls of a saved packing the masses and the contact law of the scene. The walls keep their positions.
/// @throws InputError if the packing and the scene differ in the axes with walls or in the axes with an open end, or if
/// the packing has gravity but the scene has none
template <int Dim>
void take_walls(const BoxOptions& box, const Law& law, Packing<Dim>& packing) {
  Vec<Dim> lowest = Vec<Dim>::Zero();
  for (const Wall<Dim>& wall : packing.walls)
    if (wall.side < 0) lowest[wall.axis] = wall.position;
  const std::vector<Wall<Dim>> saved = std::move(packing.walls);
  // The distance between two opposite walls is the side of the cell, so the positions of the lower walls determine
  // those of the upper walls.
  packing.walls = walls_around(packing, box, lowest);
  for (int a = 0; a < Dim; ++a)
    if (between_walls(saved, a) != between_walls(packing.walls, a))
      throw InputError(
          "box.boundary",
          fmt::format(
              "the saved state has {0} along axis {1}: expected a value of box.boundary with {0} along this "
              "axis",
              between_walls(saved, a) ? "walls" : "no walls", a + 1));
  // Both lists now have walls on the same axes, in the order of the axes, with the lower wall of an axis first.
  // Therefore two walls with the same index lie at the same end of the same axis.
  for (std::size_t w = 0; w < saved.size(); ++w)
    if (saved[w].open != packing.walls[w].open)
      throw InputError(
          "box.boundary",
          fmt::format("the saved state {} at the {} end of axis {}: expected box.boundary = \"floor\" on "
                      "every axis of which only the upper end is open, and another value on all other axes",
                      saved[w].open ? "is open" : "has a wall", saved[w].side < 0 ? "lower" : "upper",
                      saved[w].axis + 1));
  // Gravity may be added to a saved state, but not removed: a scene that lacks the key box.gravity also has zero
  // gravity here, and the gravity of the state would be lost without notice.
  if (!packing.gravity.isZero(0.0) && box.gravity.isZero(0.0))
    throw InputError("box.gravity", "the saved state has gravity, but the scene has none: expected this key");
  packing.wall_law = wall_law(law, box);
  packing.gravity = box.gravity.head<Dim>();
  refresh_contacts(packing);
}

/// Checks the number of threads and returns the options unchanged.
/// @throws InputError if the number of threads is out of its range
RunOptions checked(RunOptions options) {
  require_in_range("threads", options.relaxation.threads, RunOptions::kThreads);
  return options;
}

}  // namespace

template <int Dim>
Run<Dim>::Run(RunOptions options)
    : options_(checked(std::move(options))),
      plan_(plan_run(options_.assembly, options_.law, options_.load, Dim)) {
  RandomStream random(options_.seed, kAssemblyStream);
  const AssemblyOptions& assembly = options_.assembly;
  const bool starts_from_gas = assembly.protocol != AssemblyOptions::Protocol::state;
  take(starts_from_gas ? gas(random) : saved_packing());
  // The gas between walls has velocities that fit the own masses of its grains.
  if (options_.relaxation.equal_masses && assembly.box && starts_from_gas)
    send_off(packing_, assembly.box->kinetic_pressure, random);
  point_.aggregating = assembly.protocol == AssemblyOptions::Protocol::aggregation;
  if (assembly.agitation > 0.0) agitate(packing_, agitation_speed(), random);
  point_.stream_state = random.state();
  shake_and_start_step();
}

template <int Dim>
Run<Dim>::Run(RunOptions options, RunPoint point, Packing<Dim> packing)
    : options_(checked(std::move(options))),
      plan_(plan_run(options_.assembly, options_.law, options_.load, Dim)),
      point_(std::move(point)) {
  take(std::move(packing));
  if (!finished()) shake_and_start_step();
}

/// Returns the saved packing from which the run starts, and sets the members of point_ that refer to it.
template <int Dim>
Packing<Dim> Run<Dim>::saved_packing() {
  const AssemblyOptions& assembly = options_.assembly;
  Packing<Dim> packing =
      start_from<Dim>(assembly.saved.read_packing<Dim>(), options_.law, assembly.saved.copies_along<Dim>());
  point_.parent_sha256 = assembly.saved.sha256;
  if (assembly.saved.kept) {
    const Vec<Dim> sides = packing.cell.matrix.diagonal();
    point_.last_sides.assign(sides.begin(), sides.end());
    point_.last_stress = assembly.saved.kept->stress;
  }
  if (assembly.box) take_walls(*assembly.box, options_.law, packing);
  return packing;
}

/// Returns the gas of grains with which the assembly starts.
template <int Dim>
Packing<Dim> Run<Dim>::gas(RandomStream& random) const {
  const AssemblyOptions& assembly = options_.assembly;
  const Law& law = plan_.front().law;
  if (assembly.box && options_.grains.shape)
    return make_boxed_shaped_gas<Dim>(options_.grains, law, *assembly.box, assembly.solid_fraction,
                                      options_.seed, random, assembly.gas);
  if (assembly.box)
    return make_boxed_gas<Dim>(options_.grains, law, *assembly.box, assembly.solid_fraction, random,
                               assembly.gas);
  if (options_.grains.shape)
    return make_shaped_gas<Dim>(options_.grains, law, assembly.solid_fraction, options_.seed, random,
                                assembly.gas);
  return make_gas<Dim>(options_.grains, law, assembly.solid_fraction, random, assembly.gas);
}

/// Takes a packing whose grains have their own masses. If the options ask for equal masses, its grains get the mass of
/// the heaviest one.
template <int Dim>
void Run<Dim>::take(Packing<Dim> packing) {
  packing_ = std::move(packing);
  if (!options_.relaxation.equal_masses) return;
  own_masses_ = packing_.grains.mass;
  std::ranges::fill(packing_.grains.mass, largest_mass(packing_.grains));
}

/// Gives the grains of a packing, which take() has received, their own masses again.
template <int Dim>
void Run<Dim>::give_own_masses(Packing<Dim>& packing) const {
  if (options_.relaxation.equal_masses) packing.grains.mass = own_masses_;
}

namespace {

/// Returns the point that a run has reached just after an equilibrium was saved.
/// @param state  the saved equilibrium, whose packing is not read
/// @param cell  matrix of the lattice vectors of the packing
/// @param sha256  SHA-256 checksum of the file in which the state was saved
template <int Dim>
RunPoint point_after(const State<Dim>& state, const Mat<Dim>& cell, const std::string& sha256) {
  RunPoint point;
  point.step = state.path.step + 1;
  point.stream_state = state.provenance.stream_state;
  point.time = state.path.time;
  point.n_steps = state.path.n_steps;
  point.parent_sha256 = sha256;
  for (int a = 0; a < Dim; ++a) {
    point.last_sides.push_back(cell(a, a));
    point.last_stress.push_back(state.target_stress[a]);
  }
  point.turn = state.path.turn;
  return point;
}

}  // namespace

template <int Dim>
RunPoint point_after(const State<Dim>& state, const std::string& sha256) {
  return point_after(state, state.packing.cell.matrix, sha256);
}

/// Returns the root mean square speed V0 of the grains at the start of the assembly. V0 = agitation * V*, where
/// `agitation` is an option of the assembly and V* = sqrt(F0 D0/m) with the pull-off force F0, the range D0 of the
/// adhesion and the mass m of the largest grain (docs/physics.md, "Assembly and loading"). If no adhesion acts across a
/// gap, V* = sqrt(P a^Dim/m) with the first pressure P and the largest diameter a: the kinetic energy of a grain is
/// then comparable to the work that the pressure does on it.
template <int Dim>
double Run<Dim>::agitation_speed() const {
  const Grains<Dim>& g = packing().grains;
  const double m = largest_mass(g);
  const double a = largest_diameter(g);
  const double adhesive = options_.law.pull_off_force() * options_.law.range();
  const double energy = adhesive > 0.0 ? adhesive : options_.assembly.pressure * std::pow(a, Dim);
  return options_.assembly.agitation * std::sqrt(energy / m);
}

template <int Dim>
const Packing<Dim>& Run<Dim>::packing() const {
  if (aggregation_) return aggregation_->packing();
  return equilibrator_ ? equilibrator_->packing() : packing_;
}

template <int Dim>
void Run<Dim>::take_packing_back() {
  if (aggregation_) packing_ = std::move(*aggregation_).packing();
  if (equilibrator_) packing_ = equilibrator_->release_packing();
  aggregation_.reset();
  equilibrator_.reset();
}

/// Starts the computation of the next equilibrium. Before that, vibrates the packing if the plan of the run has a
/// vibration before this equilibrium.
/// @pre the packing is in packing_
template <int Dim>
void Run<Dim>::shake_and_start_step() {
  if (target().vibration && !point_.shaken) {
    RandomStream random(options_.seed, kVibrationStream);
    vibrate(packing_, *target().vibration, random);
    find_contacts(packing_);
    point_.shaken = true;
  }
  start_step();
}

/// Prepares the next step of a stage with different loads on its axes. At the first step of the stage, records the last
/// saved state, from which the strains of the stage are measured. In a simple shear, replaces the lattice vectors
/// before each step by less tilted vectors that span the same lattice.
/// @pre the packing is in packing_
template <int Dim>
void Run<Dim>::begin_stage() {
  if (target().is_isotropic())
    point_.turn = {};
  else if (point_.turn.empty() || point_.step == 0 || plan_[point_.step - 1].stage != target().stage)
    point_.turn = {target().control, target().axis, point_.last_sides, point_.last_stress};
  if (!target().shears()) return;
  point_.turn.shear = target().shear;
  if (!point_.equilibration.empty()) return;
  reduce_tilt(packing_, target().axis);
  point_.last_offset = packing_.cell.matrix(target().axis, 0);
}

template <int Dim>
LoadTarget<Dim> Run<Dim>::load() const {
  if (target().is_isotropic()) return LoadTarget<Dim>::normal_stress(Vec<Dim>::Constant(target().pressure));
  LoadTarget<Dim> load = load_target<Dim>(target().axes, point_.turn);
  const int axis = target().axis;
  if (target().shears())
    load.offset = ImposedOffset{axis, point_.last_offset + target().shear_step * point_.turn.sides[axis]};
  return load;
}

template <int Dim>
double Run<Dim>::pressure() const {
  return target().is_isotropic() ? target().pressure : equilibrator_->target_stress().mean();
}

namespace {

std::string pressure_words(double mean, std::optional<double> driven) {
  return driven ? fmt::format("P = {:.4g} (mean), {:.4g} (driven)", mean, *driven)
                : fmt::format("P = {:.4g}", mean);
}

}  // namespace

template <int Dim>
std::string imposed_pressure_text(const State<Dim>& state) {
  const Vec<Dim>& stress = state.target_stress;
  const StageReference& turn = state.path.turn;
  return pressure_words(stress.mean(), turn.empty() ? std::nullopt : std::optional(stress[turn.axis]));
}

template std::string imposed_pressure_text(const State<2>&);
template std::string imposed_pressure_text(const State<3>&);

template <int Dim>
std::string Run<Dim>::pressure_text() const {
  if (target().is_isotropic()) return pressure_words(pressure(), std::nullopt);
  return pressure_words(pressure(), equilibrator_->target_stress()[target().axis]);
}

/// Starts the aggregation of the grains, or the relaxation of the packing to the next equilibrium.
/// @pre the packing is in packing_
template <int Dim>
void Run<Dim>::start_step() {
  if (point_.aggregating) {
    aggregation_ = std::make_unique<Aggregation<Dim>>(target().cell.applied_to(options_.relaxation),
                                                      std::move(packing_), point_.aggregation_skin);
    pass_observer();
    return;
  }
  begin_stage();
  if (packing_.law != target().law) {
    // The new contact law changes the contact forces. The new forces are computed here, because the relaxation begins
    // by comparing the stress in the packing with the imposed stress.
    packing_.law = target().law;
    if (options_.assembly.box) packing_.wall_law = wall_law(packing_.law, *options_.assembly.box);
    refresh_contacts(packing_);
    spread_liquid(packing_);
  }
  equilibrator_ = make_equilibrator<Dim>(target().cell.applied_to(options_.relaxation), std::move(packing_),
                                         load(), point_.equilibration);
  pass_observer();
}

template <int Dim>
void Run<Dim>::set_observer(MotionObserver<Dim> observer) {
  observer_ = std::move(observer);
  pass_observer();
}

/// Passes the observer on to the object that moves the packing. The observer gets the time since the beginning of the
/// run. However, aggregation_ counts time from the beginning of the present chunk of time steps, and equilibrator_
/// counts time from the beginning of the relaxation. The time of the run before that is therefore added.
template <int Dim>
void Run<Dim>::pass_observer() {
  if (!observer_.callback || finished()) return;
  MotionObserver<Dim> here = observer_;
  here.callback = [this](const Packing<Dim>& packing, double time) {
    observer_.callback(packing, point_.time + time);
  };
  if (point_.aggregating)
    aggregation_->set_observer(std::move(here));
  else
    equilibrator_->set_observer(std::move(here));
}

template <int Dim>
RunEvent Run<Dim>::advance() {
  assert(!finished());
  if (point_.aggregating) {
    point_.aggregating = !aggregation_->advance();
    point_.aggregation_skin = aggregation_->skin();
    point_.time += aggregation_->chunk_time();
    point_.n_steps += kStepsPerChunk;
    if (!point_.aggregating) {
      take_packing_back();
      if (target().cell.applied_to(options_.relaxation).softening > 1.0)
        point_.equilibration = progress_on_soft_springs();
      start_step();
      return RunEvent::chunk;
    }
    const double longest = options_.relaxation.max_time * inertial_time(packing(), Vec<Dim>(Vec<Dim>::Zero()));
    return point_.time > longest ? RunEvent::gave_up : RunEvent::chunk;
  }
  const RelaxationStatus status = equilibrator_->advance();
  const RelaxationReport reached = equilibrator_->report();
  point_.equilibration = equilibrator_->progress();
  point_.equilibration_time = reached.time;
  point_.equilibration_steps = reached.n_steps;
  if (status == RelaxationStatus::running) return RunEvent::chunk;
  return status == RelaxationStatus::converged ? RunEvent::equilibrium : RunEvent::gave_up;
}

template <int Dim>
PathPosition Run<Dim>::path() const {
  const RelaxationReport reached = equilibrator_ ? equilibrator_->report() : RelaxationReport{};
  return {point_.step,
          target().branch,
          point_.time + point_.equilibration_time,
          point_.n_steps + point_.equilibration_steps,
          reached.ending,
          point_.turn,
          reached.counts};
}

template <int Dim>
State<Dim> Run<Dim>::state() const {
  State<Dim> state = state_without_packing();
  state.packing = packing();
  give_own_masses(state.packing);
  // The kinetic energy depends on the masses.
  if (!equilibrator_ || options_.relaxation.equal_masses) measure(state);
  return state;
}

template <int Dim>
State<Dim> Run<Dim>::release_state() {
  State<Dim> state = state_without_packing();
  const bool measured = equilibrator_ && !options_.relaxation.equal_masses;
  take_packing_back();
  state.packing = std::move(packing_);
  give_own_masses(state.packing);
  if (!measured) measure(state);
  return state;
}

/// Moves the packing back into this object and continues the present step. The object that moved the packing
/// (aggregation_ or equilibrator_) is constructed anew. Results do not change, because between two chunks of time
/// steps, point_ and the packing determine the rest of the run.
template <int Dim>
void Run<Dim>::restore_packing(Packing<Dim> packing) {
  take(std::move(packing));
  start_step();
}

/// Returns the present state without its packing. During a relaxation, the stress, the residuals and the number of
/// negative eigenvalues of the stiffness matrix are copied from equilibrator_, which has already computed them.
template <int Dim>
State<Dim> Run<Dim>::state_without_packing() const {
  State<Dim> state;
  state.units = options_.units;
  state.target_side = load().side;
  state.target_offset = load().offset;
  state.target_stress =
      equilibrator_ ? equilibrator_->target_stress() : Vec<Dim>(Vec<Dim>::Constant(target().pressure));
  state.tolerance = options_.relaxation.tolerance;
  if (equilibrator_) {
    const RelaxationReport reached = equilibrator_->report();
    state.stress = equilibrator_->stress();
    state.residuals = reached.residuals;
    state.n_negative = reached.stability.n_negative.value_or(-1);
    state.n_bridges_unsettled = reached.n_bridges_unsettled;
    state.motion = reached.motion;
  }
  state.path = path();
  state.scene = options_.text;
  state.provenance.program = "floc " + version();
  state.provenance.commit = commit();
  state.provenance.compiler = compiler();
  state.provenance.seed = options_.seed;
  state.provenance.stream_state = point_.stream_state;
  state.provenance.parent_sha256 = point_.parent_sha256;
  return state;
}

template <int Dim>
RelaxationReport Run<Dim>::report() const {
  if (!point_.aggregating) return equilibrator_->report();
  RelaxationReport report;
  report.blocking =
      fmt::format("the grains form {} clusters, but the aggregation ends only when they form one cluster",
                  aggregation_->n_clusters());
  return report;
}

template <int Dim>
void Run<Dim>::saved(const std::string& sha256) {
  const State<Dim> reached = state_without_packing();
  take_packing_back();
  point_ = point_after(reached, packing_.cell.matrix, sha256);
  if (!finished()) shake_and_start_step();
}

template RunPoint point_after(const State<2>&, const std::string&);
template RunPoint point_after(const State<3>&, const std::string&);
template class Run<2>;
template class Run<3>;

}  // namespace floc
