#include "floc/relaxation/explicit_dynamics.h"

#include <algorithm>
#include <cmath>

#include "floc/base/thread_team.h"
#include "floc/neighbors/space_order.h"
#include "floc/relaxation/contact_histories.h"
#include "floc/relaxation/packing_from_motion.h"

namespace floc {
namespace {

/// The motion counts as diverged if a coordinate of a grain, in units of the shortest side of the cell, exceeds this
/// number. The search for neighbours works for coordinates up to ten times as large.
constexpr double kFurthest = 1e8;

template <int Dim>
LatticeShape shape_of(const Cell<Dim>& cell, const BoundaryControl<Dim>& control) {
  return cell.rectangular() && cell.velocity.isDiagonal(0.0) && control.keeps_rectangular()
             ? LatticeShape::rectangular
             : LatticeShape::triangular;
}

template <int Dim>
SkinRule skin_rule(const Packing<Dim>& packing, const DynamicsSettings& settings) {
  // If the liquid is shared out whenever lists of neighbours are built, the skin (extra distance up to which pairs are
  // listed) determines when the liquid is shared out. To keep results reproducible, this skin must not depend on
  // computing times.
  return packing.law.liquid() && !settings.holds_liquid ? SkinRule::follows_reach : SkinRule::balances_costs;
}

}  // namespace

template <int Dim>
ExplicitDynamics<Dim>::ExplicitDynamics(Packing<Dim>& packing, const BoundaryControl<Dim>& control,
                                        const DynamicsSettings& settings)
    : law_(packing.law),
      wall_law_(packing.wall_law),
      gravity_(packing.gravity),
      dt_(settings.time_step),
      grains_(packing.grains, space_order(packing.cell, packing.grains)),
      cell_(packing.cell, packing.walls, control),
      interactions_(packing, settings.instructions, shape_of(packing.cell, control)),
      lists_(grains_, cell_, settings.skin, skin_rule(packing, settings)),
      sweep_(grains_, settings.threads, cell_.follows_stress()) {
  if (law_.liquid()) {
    liquid_.emplace(law_, grains_, settings.holds_liquid);
    interactions_.between_grains().set_range(liquid_->first_reach(packing));
  }
  const ContactHistories<Dim> histories(packing, grains_);
  build_lists(histories.further_contacts());
  histories.load_into(interactions_);
  share_liquid();
  refresh_forces();
}

template <int Dim>
void ExplicitDynamics<Dim>::advance(int n_steps, Motion motion) {
  run_in_team(sweep_.n_threads(), [&](int thread, Barrier& barrier) {
    Rotation from = Rotation::at_end;
    for (int k = 0; k < n_steps; ++k) {
      // Spins at the end of a step are needed only under power control and after the last step.
      const Rotation to = k + 1 < n_steps && motion == Motion::free ? Rotation::in_middle : Rotation::at_end;
      step(thread, barrier, motion, from, to);
      from = to;
    }
    measure_motion(thread);  // the function skin() uses the motion measured here
    barrier.wait();
    if (thread == 0) lists_.motion().take_measured();
  });
}

template <int Dim>
void ExplicitDynamics<Dim>::step(int thread, Barrier& barrier, Motion motion, Rotation from, Rotation to) {
  if (thread == 0) begin_step();
  barrier.wait();
  if (has_gravity()) fall(thread), barrier.wait();
  std::optional<Rotation> undrifted;
  if (lists_.stale(cell_, range())) {
    // All grains are moved first, since the new lists are built for the positions at the end of the step.
    sweep_.drift_all(thread, interactions_, step_, from);
    measure_motion(thread);
    barrier.wait();
    if (thread == 0) renew_stale_lists();
  } else {
    sweep_.drift_shared(thread, interactions_, step_, from);
    undrifted = from;
  }
  barrier.wait();
  sweep_.compute(thread, interactions_, step_, undrifted, to);
  barrier.wait();
  sweep_.sum_shared(thread, interactions_, step_, to);
  barrier.wait();
  if (has_gravity()) fall(thread), barrier.wait();
  if (thread == 0) end_step(motion);
}

template <int Dim>
void ExplicitDynamics<Dim>::begin_step() {
  cell_.advance_strain_ramp(dt_);
  cell_.kick(0.5 * dt_, sweep_.sums());
  step_.drift = cell_.drift(dt_);
  step_.kick = cell_.kick_of_grains(0.5 * dt_);
  step_.cell = cell_.pair_cell(dt_);
  lists_.add_step(cell_, sweep_.sums(), step_.kick, step_.drift, 0.5 * dt_ * gravity_.norm());
}

// Gravity changes the velocities directly and is not added to the forces, so that the loops over pairs need no term for
// gravity. Along axes with gravity, the boundary is at rest or consists of walls, so the kick of the boundary does not
// change velocities of grains.
template <int Dim>
void ExplicitDynamics<Dim>::fall(int thread) {
  sweep_.for_each_block(thread, [&](int block) {
    const int first = block * kGrainBlock, last = std::min(first + kGrainBlock, grains_.size());
    for (int a = 0; a < Dim; ++a) {
      const double change = 0.5 * dt_ * gravity_[a];
      for (int k = first; k < last; ++k) grains_.v[a][k] += change;
    }
  });
}

template <int Dim>
void ExplicitDynamics<Dim>::end_step(Motion motion) {
  if (interactions_.with_walls()) cell_.sum_forces_on_walls(interactions_.on_walls());
  cell_.kick(0.5 * dt_, sweep_.sums());
  if (motion == Motion::power_control) stop_if_slowing();
}

/// Returns twice the kinetic energy of the grains (energy). With gravity, the energy is computed from the velocities:
/// the sums of class ForceSweep are too old, since they do not contain the change of velocity by gravity in the last
/// half step.
template <int Dim>
double ExplicitDynamics<Dim>::twice_kinetic_energy_of_grains() const {
  if (!has_gravity()) return sweep_.twice_kinetic_energy();
  double twice = 0.0;
  for (const BlockSums<Dim>& s : sweep_.sums()) twice += s.rotation;
  for (int k = 0; k < grains_.size(); ++k) {
    double speed_squared = 0.0;
    for (int a = 0; a < Dim; ++a) speed_squared += grains_.v[a][k] * grains_.v[a][k];
    twice += grains_.mass[k] * speed_squared;
  }
  return twice;
}

/// Sets the velocities of grains and boundary to zero if their kinetic energy has fallen in the last step.
template <int Dim>
void ExplicitDynamics<Dim>::stop_if_slowing() {
  double twice_kinetic = twice_kinetic_energy_of_grains();
  twice_kinetic += cell_.twice_kinetic_energy_of_lattice();
  twice_kinetic += cell_.walls().twice_kinetic_energy();
  if (twice_kinetic < twice_kinetic_) {
    grains_.stop();
    sweep_.stop();
    cell_.stop();
    twice_kinetic = 0.0;
  }
  twice_kinetic_ = twice_kinetic;
}

template <int Dim>
void ExplicitDynamics<Dim>::measure_motion(int thread) {
  const StepKernels<Dim>& kernels = interactions_.between_grains().kernels();
  sweep_.for_each_block(thread, [&](int b) { lists_.motion().measure(b, kernels, step_.grains); });
}

/// Computes the forces for the present positions and velocities, without a time step. Contact springs are not
/// stretched; only history variables beyond their caps change.
template <int Dim>
void ExplicitDynamics<Dim>::refresh_forces() {
  step_.kick = cell_.kick_of_grains(0.0);
  step_.cell = cell_.pair_cell(0.0);
  for (int thread = 0; thread < sweep_.n_threads(); ++thread)
    sweep_.compute(thread, interactions_, step_, std::nullopt, Rotation::at_end);
  for (int thread = 0; thread < sweep_.n_threads(); ++thread)
    sweep_.sum_shared(thread, interactions_, step_, Rotation::at_end);
  // The kick that has just been made had a time step of zero, so it gives no upper bound of the speeds in the next
  // step.
  lists_.motion().forget();
  if (interactions_.with_walls()) cell_.sum_forces_on_walls(interactions_.on_walls());
}

/// Builds new lists of neighbours if the measured motion makes the present lists stale (NeighborLists::stale()).
/// @pre the motion of all blocks has been measured
template <int Dim>
void ExplicitDynamics<Dim>::renew_stale_lists() {
  lists_.motion().take_measured();
  // If the motion has diverged, no lists can be built; the caller detects this with finite().
  if (!lists_.stale(cell_, range()) || !finite()) return;
  Interaction<Dim>& between_grains = interactions_.between_grains();
  if (liquid_) between_grains.set_range(liquid_->reach(grains_, cell_, between_grains));
  build_lists(interactions_.further_contacts());
  share_liquid();
}

template <int Dim>
void ExplicitDynamics<Dim>::build_lists(const PairLists<Dim>& further) {
  if (!finite()) return;
  // frees the memory of the rows (forces and moments of the pairs), so that the new pairs can use it
  sweep_.drop_rows();
  interactions_.set_pairs(lists_.find(grains_, cell_, interactions_), further, grains_, dt_,
                          sweep_.blocks_of_group());
  sweep_.plan(interactions_);
  if (interactions_.with_walls()) cell_.list_pairs_of_walls(interactions_.on_walls().pairs());
  step_.grains = lists_.motion().view_of(grains_);
}

/// Shares the liquid out among the pairs of grains, unless the bridges keep their volumes. Builds new lists of pairs
/// until the lists contain all pairs that get liquid.
template <int Dim>
void ExplicitDynamics<Dim>::share_liquid() {
  if (!liquid_ || liquid_->keeps_shares()) return;
  while (!liquid_->share_out(grains_, cell_, interactions_.between_grains()))
    build_lists(interactions_.further_contacts());
}

template <int Dim>
double ExplicitDynamics<Dim>::skin() const {
  return lists_.skin_to_continue_with(cell_, range());
}

template <int Dim>
bool ExplicitDynamics<Dim>::finite() const {
  bool all = cell_.finite();
  const double furthest = kFurthest * cell_.shortest_side();
  for (const auto& component : grains_.x)
    for (const double x : component) all = all && std::abs(x) < furthest;
  return all;
}

template <int Dim>
Packing<Dim> ExplicitDynamics<Dim>::release_packing() {
  sweep_.drop_rows();
  lists_.motion().release();
  interactions_.keep_history_alone();
  return packing();
}

template <int Dim>
Packing<Dim> ExplicitDynamics<Dim>::packing() const {
  Packing<Dim> packing = packing_from_motion(grains_, cell_, interactions_, law_, wall_law_);
  packing.gravity = gravity_;
  return packing;
}

template <int Dim>
std::unique_ptr<Dynamics<Dim>> make_dynamics(const Packing<Dim>& packing, const BoundaryControl<Dim>& control,
                                             const DynamicsSettings& settings) {
  Packing<Dim> copy = packing;
  return make_dynamics(copy, control, settings);
}

template <int Dim>
std::unique_ptr<Dynamics<Dim>> make_dynamics(Packing<Dim>& packing, const BoundaryControl<Dim>& control,
                                             const DynamicsSettings& settings) {
  return std::make_unique<ExplicitDynamics<Dim>>(packing, control, settings);
}

#define FLOC_INSTANTIATE(Dim)                                                                             \
  template std::unique_ptr<Dynamics<Dim>> make_dynamics(const Packing<Dim>&, const BoundaryControl<Dim>&, \
                                                        const DynamicsSettings&);                         \
  template std::unique_ptr<Dynamics<Dim>> make_dynamics(Packing<Dim>&, const BoundaryControl<Dim>&,       \
                                                        const DynamicsSettings&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
