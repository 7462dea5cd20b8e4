#include "floc/relaxation/force_sweep.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace floc {
namespace {

/// Largest number of blocks of grains in a group. A thread computes all pairs of a group before it sums the forces on
/// the grains of the group. A pass over pairs has a fixed cost, so very small groups of blocks are slower. With 4000
/// spheres, groups of 16 blocks are 4 % faster than single blocks and as fast as groups of 4 blocks; one group of all
/// blocks is slower.
constexpr int kMaxBlocksOfGroup = 16;

template <int Dim>
void kick_and_drift(int block, const Interactions<Dim>& interactions, const GrainStep<Dim>& step,
                    Rotation stands) {
  interactions.between_grains().kernels().kick_and_drift(step.grains, block * kGrainBlock, step.kick,
                                                         step.drift, stands);
}

}  // namespace

template <int Dim>
ForceSweep<Dim>::ForceSweep(const GrainArrays<Dim>& grains, int n_threads, const Mat<Dim, bool>& needs_virial)
    : n_grains_(grains.size()),
      max_threads_(n_threads),
      needs_virial_(needs_virial),
      sums_(grains.n_blocks()) {}

/// Returns the number of blocks per group for which every thread has equally many groups, and all groups have about
/// equally many blocks.
template <int Dim>
int ForceSweep<Dim>::blocks_of_group() const {
  const auto parts = [](int all, int most) { return (all + most - 1) / most; };
  const int groups_of_thread = parts(n_blocks(), max_threads_ * kMaxBlocksOfGroup);
  return parts(n_blocks(), max_threads_ * groups_of_thread);
}

template <int Dim>
void ForceSweep<Dim>::plan(Interactions<Dim>& interactions) {
  const Interaction<Dim>& between_grains = interactions.between_grains();
  std::vector<const PairArrays<Dim>*> lists;
  for (const Interaction<Dim>& interaction : interactions) lists.push_back(&interaction.pairs());
  plan_ = {between_grains.pairs(), n_blocks(), max_threads_, blocks_of_group()};
  rows_ = {lists, between_grains.rows(), n_grains_, plan_};
  if (interactions.with_walls()) interactions.on_walls().set_rows(rows_.rows_with_walls());
}

template <int Dim>
void ForceSweep<Dim>::drift_all(int thread, const Interactions<Dim>& interactions, const GrainStep<Dim>& step,
                                Rotation stands) const {
  for_each_block(thread, [&](int b) { kick_and_drift(b, interactions, step, stands); });
}

template <int Dim>
void ForceSweep<Dim>::drift_shared(int thread, const Interactions<Dim>& interactions,
                                   const GrainStep<Dim>& step, Rotation stands) const {
  for (const int b : plan_.shared_of(thread)) kick_and_drift(b, interactions, step, stands);
}

template <int Dim>
void ForceSweep<Dim>::compute(int thread, const Interactions<Dim>& interactions, const GrainStep<Dim>& step,
                              std::optional<Rotation> undrifted, Rotation to) {
  const Interaction<Dim>& between_grains = interactions.between_grains();
  for (int group = plan_.first_group(thread); group < plan_.first_group(thread + 1); ++group) {
    if (undrifted)
      for (const int b : plan_.drifting_for(group)) kick_and_drift(b, interactions, step, *undrifted);
    const int first = plan_.first_block(group), last = plan_.first_block(group + 1);
    const PairView<Dim> pairs = pairs_of_group(group, between_grains);
    between_grains.compute(pairs, first, last, step.grains, step.cell);
    if (interactions.with_walls()) {
      const Interaction<Dim>& on_walls = interactions.on_walls();
      on_walls.compute(on_walls.view(), first, last, step.grains, step.cell);
    }
    for (int b = first; b < last; ++b)
      if (!plan_.is_shared(b)) sum_and_kick(b, interactions, pairs, step, to);
  }
}

template <int Dim>
void ForceSweep<Dim>::sum_shared(int thread, const Interactions<Dim>& interactions, const GrainStep<Dim>& step,
                                 Rotation to) {
  for (const int b : plan_.shared_of(thread))
    sum_and_kick(b, interactions, pairs_of_group(plan_.group_of(b), interactions.between_grains()), step, to);
}

template <int Dim>
PairView<Dim> ForceSweep<Dim>::pairs_of_group(int group, const Interaction<Dim>& between_grains) {
  const int first = between_grains.pairs().first_of_block(plan_.first_block(group));
  return between_grains.view(rows_.rows_of_group(group), first);
}

template <int Dim>
void ForceSweep<Dim>::sum_and_kick(int block, const Interactions<Dim>& interactions, const PairView<Dim>& pairs,
                                   const GrainStep<Dim>& step, Rotation to) {
  interactions.between_grains().kernels().sum_and_kick(
      step.grains, pairs, rows_.plan(block), block * kGrainBlock, step.cell, step.kick, to, sums_[block]);
  if (interactions.with_walls() && needs_virial_.any())
    add_wall_virial(block, interactions.on_walls(), step.grains);
}

/// Removes the forces of the walls from the virial of a block. The kernel has computed the virial as the sum of net
/// force times position over the grains, and the net forces include the forces of the walls. Only the virial along the
/// periodic axes is needed. These axes are parallel to the walls, so the forces that are removed are wall friction.
template <int Dim>
void ForceSweep<Dim>::add_wall_virial(int block, const Interaction<Dim>& on_walls,
                                      const GrainView<Dim>& grains) {
  const PairArrays<Dim>& pairs = on_walls.pairs();
  const int size_of_row = row_size<Dim>(on_walls.rows()), force = force_in_row<Dim>(on_walls.rows());
  for (int p = pairs.first_of_block(block); p < pairs.first_of_block(block + 1); ++p) {
    if (pairs.padding(p)) continue;
    const double* on_wall = on_walls.view().row + static_cast<std::ptrdiff_t>(size_of_row) * p + force;
    for (int a = 0; a < Dim; ++a)
      for (int b = a; b < Dim; ++b)
        if (needs_virial_(a, b)) sums_[block].virial[a][b] += on_wall[a] * grains.x[b][pairs.i(p)];
  }
}

template <int Dim>
double ForceSweep<Dim>::twice_kinetic_energy() const {
  double sum = 0.0;
  for (const BlockSums<Dim>& s : sums_) {
    for (int a = 0; a < Dim; ++a) sum += s.momentum_flux[a][a];
    sum += s.rotation;
  }
  return sum;
}

template <int Dim>
void ForceSweep<Dim>::stop() {
  for (BlockSums<Dim>& s : sums_) {
    for (auto& row : s.momentum_flux) std::fill(std::begin(row), std::end(row), 0.0);
    s.rotation = 0.0;
  }
}

template class ForceSweep<2>;
template class ForceSweep<3>;

}  // namespace floc
