#include "floc/relaxation/explicit_dynamics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "floc/geometry/upper_triangular.h"
#include "floc/neighbors/space_order.h"
#include "floc/packing/contact_order.h"
#include "floc/packing/grain_sizes.h"
#include "floc/relaxation/kernel_matrix.h"
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

}  // namespace

template <int Dim>
ExplicitDynamics<Dim>::ExplicitDynamics(Packing<Dim>& packing, const BoundaryControl<Dim>& control,
                                        const DynamicsSettings& settings)
    : law_(packing.law),
      wall_law_(packing.wall_law),
      holds_liquid_(settings.holds_liquid),
      cell_(packing.cell, packing.walls, control),
      dt_(settings.time_step),
      skin_(settings.skin),
      threads_(settings.threads),
      largest_diameter_(largest_diameter(packing.grains)),
      skin_unit_(skin_length_unit(packing.grains.radius)),
      grains_(packing.grains, space_order(packing.cell, packing.grains)) {
  add_interactions(packing, settings.instructions, shape_of(packing.cell, control));
  sums_.resize(n_blocks());
  motion_of_block_.resize(n_blocks());
  if (law_.liquid()) set_first_reach(packing);
  const std::vector<History> histories = take_histories(packing);
  build_lists(further_contacts(histories));
  load_memory(histories);
  if (shares_liquid()) spread_liquid();
  refresh_forces();
}

template <int Dim>
void ExplicitDynamics<Dim>::add_interactions(const Packing<Dim>& packing, InstructionSet instructions,
                                             LatticeShape shape) {
  std::vector<Law> parameters = {packing.law};
  if (!packing.walls.empty()) parameters.push_back(packing.wall_law);
  const auto laws = laws_of_same_rows(parameters);
  for (std::size_t k = 0; k < laws.size(); ++k)
    interactions_.emplace_back(k == 0 ? Partner::grain : Partner::wall, parameters[k], laws[k],
                               row_kind<Dim>(*laws[0]), 0.5 * largest_diameter_, instructions, shape);
}

template <int Dim>
auto ExplicitDynamics<Dim>::take_histories(Packing<Dim>& packing) const -> std::vector<History> {
  std::vector<int> place(grains_.size());
  for (int k = 0; k < grains_.size(); ++k) place[grains_.index[k]] = k;
  std::vector<History> histories;
  histories.reserve(packing.contacts.size());
  for (const Contact<Dim>& c : packing.contacts) {
    const bool on_wall = c.j >= grains_.size();
    const NeighborPair<Dim> pair{place[c.i], on_wall ? c.j - grains_.size() : place[c.j], c.image, c.key};
    const bool swap = !on_wall && pair.j < pair.i;
    histories.push_back({swap ? swapped(pair) : pair, on_wall, swap, c.memory});
  }
  packing.contacts = std::vector<Contact<Dim>>();  // = {} would keep the room that they took
  return histories;
}

template <int Dim>
auto ExplicitDynamics<Dim>::further_contacts(const std::vector<History>& histories) const
    -> std::vector<Pairs> {
  std::vector<Pairs> further(interactions_.size());
  for (const History& history : histories)
    if (history.pair.key != 0) further[history.interaction()].push_back(history.pair);
  return further;
}

template <int Dim>
void ExplicitDynamics<Dim>::load_memory(const std::vector<History>& histories) {
  for (const History& history : histories) {
    Interaction<Dim>& interaction = interactions_[history.interaction()];
    const int p = interaction.pairs().find(history.pair);
    if (p >= 0) interaction.load_memory(p, history.memory, history.swapped);
  }
  if (bridges_) interactions_[0].refresh_bridges();
}

template <int Dim>
void ExplicitDynamics<Dim>::advance(int n_steps, Motion motion) {
  run_in_team(sweep_plan_.n_threads(), [&](int thread, Barrier& barrier) {
    const auto for_each_block = [&](const auto& visit) {  // of this thread
      const int last = sweep_plan_.first_block(sweep_plan_.first_group(thread + 1));
      for (int b = sweep_plan_.first_block(sweep_plan_.first_group(thread)); b < last; ++b) visit(b);
    };
    Rotation stands = Rotation::at_end;
    for (int step = 0; step < n_steps; ++step) {
      // Nobody asks for spins before the last of the steps, but power control, which stops the grains.
      const Rotation next =
          step + 1 < n_steps && motion == Motion::free ? Rotation::in_middle : Rotation::at_end;
      if (thread == 0) begin_step();
      barrier.wait();
      const bool drifts_first = list_is_stale();
      if (drifts_first) {
        for_each_block([&](int b) { kick_and_drift(b, stands); });
        for_each_block([&](int b) { measure_motion(b); });
        barrier.wait();
        if (thread == 0) renew_list();
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
    for_each_block([&](int b) { measure_motion(b); });
    barrier.wait();
    if (thread == 0) take_measured_motion();
  });
}

template <int Dim>
void ExplicitDynamics<Dim>::begin_step() {
  cell_.advance_strain_ramp(dt_);
  cell_.kick(0.5 * dt_, sums_);
  drift_ = cell_.drift(dt_);
  kick_ = cell_.kick_of_grains(0.5 * dt_);
  list_stretch_ = right_quotient<Dim>(cell_.lattice(), lattice_at_list_);
  bound_motion();
  ++steps_since_list_;
}

template <int Dim>
void ExplicitDynamics<Dim>::kick_and_drift(int block, Rotation stands) {
  interactions_[0].kernels().kick_and_drift(grain_view_, block * kGrainBlock, kick_, drift_, stands);
}

template <int Dim>
void ExplicitDynamics<Dim>::measure_motion(int block) {
  double list_stretch[Dim][Dim];
  copy_matrix<Dim>(list_stretch_, list_stretch);
  motion_of_block_[block] =
      std::sqrt(interactions_[0].kernels().motion_squared(grain_view_, block * kGrainBlock, list_stretch));
}

/// Those whose pairs are computed in one pass: as many for each thread, and nearly equal.
template <int Dim>
int ExplicitDynamics<Dim>::blocks_of_group() const {
  const auto parts = [](int all, int most) { return (all + most - 1) / most; };
  const int groups_of_thread = parts(n_blocks(), threads_ * kBlocksOfGroup);
  return parts(n_blocks(), threads_ * groups_of_thread);
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
    interactions_[0].compute(pairs, first, last, grain_view_, cell);
    if (!cell_.walls().empty())
      interactions_[1].compute(interactions_[1].view(), first, last, grain_view_, cell);
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
  const int first = interactions_[0].pairs().first_of_block(sweep_plan_.first_block(group));
  return interactions_[0].view(sums_of_rows_.rows_of_group(group), first);
}

template <int Dim>
void ExplicitDynamics<Dim>::sum_and_kick(const PairView<Dim>& pairs, int block, Rotation to) {
  interactions_[0].kernels().sum_and_kick(grain_view_, pairs, sums_of_rows_.plan(block), block * kGrainBlock,
                                          cell_.pair_cell(0.0), kick_, to, sums_[block]);
  if (cell_.follows_stress().any() && !cell_.walls().empty()) add_wall_virial(block);
}

/// The kernel sums forces on grains times their positions: along the periodic axes, to which walls are parallel,
/// nothing is to be left of the friction that they exert.
template <int Dim>
void ExplicitDynamics<Dim>::add_wall_virial(int block) {
  const Interaction<Dim>& interaction = interactions_.back();
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
  cell_.sum_forces_on_walls(interactions_.back());
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
  moved_ = std::numeric_limits<double>::infinity();  // a kick of no time tells nothing of the next speeds
  cell_.sum_forces_on_walls(interactions_.back());
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
  x_list_ = {};
  for (Interaction<Dim>& interaction : interactions_) interaction.keep_memory_alone();
  return packing();
}

template <int Dim>
Packing<Dim> ExplicitDynamics<Dim>::packing() const {
  Packing<Dim> out;
  out.law = law_;
  out.walls = cell_.walls().walls();
  out.wall_law = wall_law_;
  // Centres without low parts: motion ends at the rounding of a double.
  out.grains = Grains<Dim>::with_size(grains_.size());
  out.grains.id = grains_.id;
  out.cell = cell_.cell();
  std::vector<Vec<Dim, int>> wrap(grains_.size());
  for (int k = 0; k < grains_.size(); ++k) {
    const int i = grains_.index[k];
    Vec<Dim>& x = out.grains.position[i];
    for (int a = 0; a < Dim; ++a) {
      x[a] = grains_.x[a][k];
      out.grains.velocity[i][a] = grains_.v[a][k];
    }
    wrap[k] = cell_.wrap(x);
    for (int a = 0; a < kRotations<Dim>; ++a) out.grains.angular_velocity[i][a] = grains_.spin[a][k];
    out.grains.orientation[i] = grains_.orientation_of(k);
    out.grains.radius[i] = grains_.radius[k];
    out.grains.mass[i] = grains_.mass[k];
  }
  for (const Interaction<Dim>& interaction : interactions_) append_contacts(interaction, wrap, out);
  std::sort(out.contacts.begin(), out.contacts.end(), precedes<Contact<Dim>>);
  refresh_contacts(out);
  return out;
}

/// What an interaction remembers of pairs within its range. @param wrap  images that bring the grains into the
/// cell
template <int Dim>
void ExplicitDynamics<Dim>::append_contacts(const Interaction<Dim>& interaction,
                                            const std::vector<Vec<Dim, int>>& wrap, Packing<Dim>& out) const {
  const PairArrays<Dim>& pairs = interaction.pairs();
  const bool with_walls = interaction.partner() == Partner::wall;
  out.contacts.reserve(out.contacts.size() + pairs.size());
  for (int p = 0; p < pairs.size(); ++p) {
    if (pairs.padding(p)) continue;
    NeighborPair<Dim> key = pairs.key(p);
    const double reach = pairs.radii(p) + interaction.range();
    const bool wet = !pairs.bridge_volume().empty() && pairs.bridge_volume()[p] != 0.0;
    if (with_walls) {
      const Wall<Dim>& wall = cell_.walls().walls()[key.j];
      if (wall.side * (wall.position - grains_.x[wall.axis][key.i]) >= reach) continue;
      key = {grains_.index[key.i], grains_.size() + key.j, key.image, key.key};
    } else {
      const Vec<Dim> shift = cell_.image_shift(key.image);
      Vec<Dim> r;
      for (int a = 0; a < Dim; ++a) r[a] = grains_.x[a][key.j] - grains_.x[a][key.i] + shift[a];
      if (r.squaredNorm() >= reach * reach && !wet) continue;
      key = {grains_.index[key.i], grains_.index[key.j], key.image + wrap[key.i] - wrap[key.j], key.key};
    }
    const bool swap = key.j < key.i;
    if (swap) key = swapped(key);
    Contact<Dim> c;
    c.i = key.i;
    c.j = key.j;
    c.image = key.image;
    c.key = key.key;
    c.memory = interaction.memory(p, swap);
    out.contacts.push_back(c);
  }
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
  template int ExplicitDynamics<Dim>::blocks_of_group() const;                                            \
  template std::unique_ptr<Dynamics<Dim>> make_dynamics(const Packing<Dim>&, const BoundaryControl<Dim>&, \
                                                        const DynamicsSettings&);                         \
  template std::unique_ptr<Dynamics<Dim>> take_into_motion(Packing<Dim>&, const BoundaryControl<Dim>&,    \
                                                           const DynamicsSettings&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
