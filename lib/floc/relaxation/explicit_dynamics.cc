#include "floc/relaxation/explicit_dynamics.h"

#include <algorithm>
#include <cmath>

#include "floc/neighbors/space_order.h"
#include "floc/relaxation/contact_histories.h"
#include "floc/relaxation/packing_from_motion.h"
#include "floc/relaxation/thread_team.h"

namespace floc {
namespace {

/// Blocks whose pairs a thread computes before it sums them, at most: each pass over pairs begins and ends slowly (4 %
/// faster with 4000 spheres than block by block; as fast with 4, slower with all).
constexpr int kBlocksOfGroup = 16;
/// How far a grain may be, in sides of the cell; the search for neighbours can hold ten times as much.
constexpr double kFurthest = 1e8;

template <int Dim>
LatticeShape shape_of(const Cell<Dim>& cell, const BoundaryControl<Dim>& control) {
  return cell.rectangular() && cell.velocity.isDiagonal(0.0) && control.keeps_rectangular()
             ? LatticeShape::rectangular
             : LatticeShape::triangular;
}

template <int Dim>
SkinRule skin_rule(const Packing<Dim>& packing, const DynamicsSettings& settings) {
  // Where liquid is shared out with every list, the skin decides when, and must not follow what lists cost.
  return packing.law.liquid() && !settings.holds_liquid ? SkinRule::follows_reach : SkinRule::balances_costs;
}

}  // namespace

template <int Dim>
ExplicitDynamics<Dim>::ExplicitDynamics(Packing<Dim>& packing, const BoundaryControl<Dim>& control,
                                        const DynamicsSettings& settings)
    : law_(packing.law),
      wall_law_(packing.wall_law),
      dt_(settings.time_step),
      threads_(settings.threads),
      grains_(packing.grains, space_order(packing.cell, packing.grains)),
      cell_(packing.cell, packing.walls, control),
      interactions_(packing, settings.instructions, shape_of(packing.cell, control)),
      lists_(grains_, cell_, settings.skin, skin_rule(packing, settings)),
      sums_(grains_.n_blocks()) {
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
  run_in_team(sweep_plan_.n_threads(), [&](int thread, Barrier& barrier) {
    const auto for_each_block = [&](const auto& visit) {  // of this thread
      const int last = sweep_plan_.first_block(sweep_plan_.first_group(thread + 1));
      for (int b = sweep_plan_.first_block(sweep_plan_.first_group(thread)); b < last; ++b) visit(b);
    };
    const StepKernels<Dim>& kernels = interactions_.between_grains().kernels();
    Rotation stands = Rotation::at_end;
    for (int step = 0; step < n_steps; ++step) {
      // Nobody asks for spins before the last of the steps, but power control, which stops the grains.
      const Rotation next =
          step + 1 < n_steps && motion == Motion::free ? Rotation::in_middle : Rotation::at_end;
      if (thread == 0) begin_step();
      barrier.wait();
      const bool drifts_first = lists_.stale(cell_, range());
      if (drifts_first) {
        for_each_block([&](int b) { kick_and_drift(b, stands); });
        for_each_block([&](int b) { lists_.motion().measure(b, kernels, grain_view_); });
        barrier.wait();
        if (thread == 0) renew_lists();
      } else {
        for (const int b : sweep_plan_.shared_of(thread)) kick_and_drift(b, stands);
      }
      barrier.wait();
      sweep(thread, dt_, drifts_first ? std::nullopt : std::optional(stands), next);
      barrier.wait();
      sum_shared_blocks(thread, next);
      barrier.wait();
      if (thread == 0) end_step(motion);
      stands = next;
    }
    // skin() asks for it.
    for_each_block([&](int b) { lists_.motion().measure(b, kernels, grain_view_); });
    barrier.wait();
    if (thread == 0) lists_.motion().take_measured();
  });
}

template <int Dim>
void ExplicitDynamics<Dim>::begin_step() {
  cell_.advance_strain_ramp(dt_);
  cell_.kick(0.5 * dt_, sums_);
  drift_ = cell_.drift(dt_);
  kick_ = cell_.kick_of_grains(0.5 * dt_);
  lists_.add_step(cell_, sums_, kick_, drift_);
}

template <int Dim>
void ExplicitDynamics<Dim>::kick_and_drift(int block, Rotation stands) {
  interactions_.between_grains().kernels().kick_and_drift(grain_view_, block * kGrainBlock, kick_, drift_,
                                                          stands);
}

/// Those whose pairs are computed in one pass: as many for each thread, and nearly equal.
template <int Dim>
int ExplicitDynamics<Dim>::blocks_of_group() const {
  const auto parts = [](int all, int most) { return (all + most - 1) / most; };
  const int groups_of_thread = parts(grains_.n_blocks(), threads_ * kBlocksOfGroup);
  return parts(grains_.n_blocks(), threads_ * groups_of_thread);
}

/// Pairs of a thread's blocks, and sums of those that it shares with no other.
template <int Dim>
void ExplicitDynamics<Dim>::sweep(int thread, double slip_time, std::optional<Rotation> undrifted,
                                  Rotation to) {
  const PairCell<Dim> cell = cell_.pair_cell(slip_time);
  for (int group = sweep_plan_.first_group(thread); group < sweep_plan_.first_group(thread + 1); ++group) {
    if (undrifted)
      for (const int b : sweep_plan_.drifting_for(group)) kick_and_drift(b, *undrifted);
    const int first = sweep_plan_.first_block(group), last = sweep_plan_.first_block(group + 1);
    const PairView<Dim> pairs = pairs_of_group(group);
    interactions_.between_grains().compute(pairs, first, last, grain_view_, cell);
    if (interactions_.with_walls()) {
      const Interaction<Dim>& on_walls = interactions_.on_walls();
      on_walls.compute(on_walls.view(), first, last, grain_view_, cell);
    }
    for (int b = first; b < last; ++b)
      if (!sweep_plan_.is_shared(b)) sum_and_kick(pairs, b, to);
  }
}

template <int Dim>
void ExplicitDynamics<Dim>::sum_shared_blocks(int thread, Rotation to) {
  for (const int b : sweep_plan_.shared_of(thread))
    sum_and_kick(pairs_of_group(sweep_plan_.group_of(b)), b, to);
}

template <int Dim>
PairView<Dim> ExplicitDynamics<Dim>::pairs_of_group(int group) {
  const int first = interactions_.between_grains().pairs().first_of_block(sweep_plan_.first_block(group));
  return interactions_.between_grains().view(sums_of_rows_.rows_of_group(group), first);
}

template <int Dim>
void ExplicitDynamics<Dim>::sum_and_kick(const PairView<Dim>& pairs, int block, Rotation to) {
  interactions_.between_grains().kernels().sum_and_kick(grain_view_, pairs, sums_of_rows_.plan(block),
                                                        block * kGrainBlock, cell_.pair_cell(0.0), kick_, to,
                                                        sums_[block]);
  if (cell_.follows_stress().any() && interactions_.with_walls()) add_wall_virial(block);
}

/// The kernel sums forces on grains times their positions: along the periodic axes, to which walls are parallel,
/// nothing is to be left of the friction that they exert.
template <int Dim>
void ExplicitDynamics<Dim>::add_wall_virial(int block) {
  const Interaction<Dim>& interaction = interactions_.on_walls();
  const PairArrays<Dim>& pairs = interaction.pairs();
  const int size_of_row = row_size<Dim>(interaction.rows()), force = force_in_row<Dim>(interaction.rows());
  for (int p = pairs.first_of_block(block); p < pairs.first_of_block(block + 1); ++p) {
    if (pairs.padding(p)) continue;
    const double* on_wall = interaction.view().row + static_cast<std::ptrdiff_t>(size_of_row) * p + force;
    for (int a = 0; a < Dim; ++a)
      for (int b = a; b < Dim; ++b)
        if (cell_.follows_stress()(a, b)) sums_[block].virial[a][b] += on_wall[a] * grains_.x[b][pairs.i(p)];
  }
}

template <int Dim>
void ExplicitDynamics<Dim>::end_step(Motion motion) {
  if (interactions_.with_walls()) cell_.sum_forces_on_walls(interactions_.on_walls());
  cell_.kick(0.5 * dt_, sums_);
  if (motion != Motion::power_control) return;
  double twice_kinetic = 0.0;
  for (const BlockSums<Dim>& s : sums_) {
    for (int a = 0; a < Dim; ++a) twice_kinetic += s.momentum_flux[a][a];
    twice_kinetic += s.rotation;
  }
  twice_kinetic += cell_.twice_kinetic_energy_of_lattice();
  twice_kinetic += cell_.walls().twice_kinetic_energy();
  if (twice_kinetic < kinetic_) {
    for (auto& component : grains_.v) std::fill(component.begin(), component.end(), 0.0);
    for (auto& component : grains_.spin) std::fill(component.begin(), component.end(), 0.0);
    for (BlockSums<Dim>& s : sums_) {
      for (auto& row : s.momentum_flux) std::fill(std::begin(row), std::end(row), 0.0);
      s.rotation = 0.0;
    }
    cell_.stop();
    twice_kinetic = 0.0;
  }
  kinetic_ = twice_kinetic;
}

/// Forces of the present positions and velocities, histories untouched but for their caps.
template <int Dim>
void ExplicitDynamics<Dim>::refresh_forces() {
  kick_ = cell_.kick_of_grains(0.0);
  for (int thread = 0; thread < sweep_plan_.n_threads(); ++thread)
    sweep(thread, 0.0, std::nullopt, Rotation::at_end);
  for (int thread = 0; thread < sweep_plan_.n_threads(); ++thread) sum_shared_blocks(thread, Rotation::at_end);
  lists_.motion().forget();  // a kick of no time tells nothing of the next speeds
  if (interactions_.with_walls()) cell_.sum_forces_on_walls(interactions_.on_walls());
}

template <int Dim>
void ExplicitDynamics<Dim>::renew_lists() {
  lists_.motion().take_measured();
  if (lists_.stale(cell_, range())) rebuild_lists();
}

template <int Dim>
void ExplicitDynamics<Dim>::rebuild_lists() {
  if (!finite()) return;  // the caller will ask; there are no neighbours to find
  if (liquid_)
    interactions_.between_grains().set_range(liquid_->reach(grains_, cell_, interactions_.between_grains()));
  build_lists(interactions_.further_contacts());
  share_liquid();
}

template <int Dim>
void ExplicitDynamics<Dim>::build_lists(const PairLists<Dim>& further) {
  if (!finite()) return;
  sums_of_rows_ = RowSums<Dim>();  // of the lists that end here
  interactions_.set_pairs(lists_.find(grains_, cell_, interactions_), further, grains_, dt_, blocks_of_group());
  std::vector<const PairArrays<Dim>*> lists;
  for (const Interaction<Dim>& interaction : interactions_) lists.push_back(&interaction.pairs());
  sweep_plan_ = {interactions_.between_grains().pairs(), grains_.n_blocks(), threads_, blocks_of_group()};
  sums_of_rows_ = {lists, interactions_.between_grains().rows(), grains_.size(), sweep_plan_};
  if (interactions_.with_walls()) {
    interactions_.on_walls().set_rows(sums_of_rows_.rows_with_walls());
    cell_.list_pairs_of_walls(interactions_.on_walls().pairs());
  }
  grain_view_ = lists_.motion().view_of(grains_);
}

/// Shares the liquid out over lists that reach far enough, unless the bridges keep their volumes.
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
  sums_of_rows_ = RowSums<Dim>();
  lists_.motion().release();
  interactions_.keep_memory_alone();
  return packing();
}

template <int Dim>
Packing<Dim> ExplicitDynamics<Dim>::packing() const {
  return packing_from_motion(grains_, cell_, interactions_, law_, wall_law_);
}

template <int Dim>
std::unique_ptr<Dynamics<Dim>> make_dynamics(const Packing<Dim>& packing, const BoundaryControl<Dim>& control,
                                             const DynamicsSettings& settings) {
  Packing<Dim> copy = packing;
  return take_into_motion(copy, control, settings);
}

template <int Dim>
std::unique_ptr<Dynamics<Dim>> take_into_motion(Packing<Dim>& packing, const BoundaryControl<Dim>& control,
                                                const DynamicsSettings& settings) {
  return std::make_unique<ExplicitDynamics<Dim>>(packing, control, settings);
}

#define FLOC_INSTANTIATE(Dim)                                                                             \
  template std::unique_ptr<Dynamics<Dim>> make_dynamics(const Packing<Dim>&, const BoundaryControl<Dim>&, \
                                                        const DynamicsSettings&);                         \
  template std::unique_ptr<Dynamics<Dim>> take_into_motion(Packing<Dim>&, const BoundaryControl<Dim>&,    \
                                                           const DynamicsSettings&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
