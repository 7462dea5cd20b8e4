#pragma once

#include <optional>
#include <vector>

#include "floc/relaxation/grain_arrays.h"
#include "floc/relaxation/interactions.h"
#include "floc/relaxation/row_sums.h"
#include "floc/relaxation/sweep_plan.h"

namespace floc {

/// A time step as the passes over the blocks of grains see it.
template <int Dim>
struct GrainStep {
  GrainView<Dim> grains;
  PairCell<Dim> cell;
  Kick<Dim> kick;    ///< of each half of the step
  Drift<Dim> drift;  ///< of the whole step, between the two kicks
};

/// The passes of a time step over blocks of grains, shared out among threads (SweepPlan). A block owns the pairs whose
/// first grain it owns: each thread computes the rows of the pairs of its blocks, and once all rows that a block
/// reads are written, its grains are summed and kicked. Sums over the packing are kept block by block, so that the
/// number of threads does not change the order of additions.
///
/// Threads call the methods with a thread's number side by side, with barriers between drift, compute and sum_shared.
template <int Dim>
class ForceSweep {
 public:
  /// @param needs_virial  components of the virial that a lattice under stress needs
  ForceSweep(const GrainArrays<Dim>& grains, int n_threads, const Mat<Dim, bool>& needs_virial);

  int n_threads() const { return plan_.n_threads(); }
  /// Blocks whose pairs are computed in one pass, which lists of pairs have to be padded for.
  int blocks_of_group() const;
  /// Drops the rows. @pre plan() follows, or no step does
  void drop_rows() { rows_ = RowSums<Dim>(); }
  /// Plans the passes over new lists of pairs.
  void plan(Interactions<Dim>& interactions);

  /// Calls visit(block) for each block of a thread.
  template <class Visit>
  void for_each_block(int thread, const Visit& visit) const {
    const int last = plan_.first_block(plan_.first_group(thread + 1));
    for (int b = plan_.first_block(plan_.first_group(thread)); b < last; ++b) visit(b);
  }
  /// Kicks and moves all blocks of a thread, or only those that it has of the blocks shared by several threads.
  /// @param stands  how the rotation of the grains stands
  void drift_all(int thread, const Interactions<Dim>& interactions, const GrainStep<Dim>& step,
                 Rotation stands) const;
  void drift_shared(int thread, const Interactions<Dim>& interactions, const GrainStep<Dim>& step,
                    Rotation stands) const;
  /// Computes the pairs of a thread's blocks, and sums the blocks that it shares with no other thread.
  /// @param undrifted  how the rotation of the grains stands where blocks that are not shared have still to drift,
  ///                   each just before pairs read it
  /// @param to         where to leave the rotation
  void compute(int thread, const Interactions<Dim>& interactions, const GrainStep<Dim>& step,
               std::optional<Rotation> undrifted, Rotation to);
  /// Sums the shared blocks of a thread, after the pairs of all threads have been computed.
  void sum_shared(int thread, const Interactions<Dim>& interactions, const GrainStep<Dim>& step, Rotation to);

  /// What each block adds to the sums over the packing.
  const std::vector<BlockSums<Dim>>& sums() const { return sums_; }
  double twice_kinetic_energy() const;
  /// Sets the sums over velocities to zero, after the grains have been stopped.
  void stop();

 private:
  int n_blocks() const { return static_cast<int>(sums_.size()); }
  PairView<Dim> pairs_of_group(int group, const Interaction<Dim>& between_grains);
  void sum_and_kick(int block, const Interactions<Dim>& interactions, const PairView<Dim>& pairs,
                    const GrainStep<Dim>& step, Rotation to);
  void add_wall_virial(int block, const Interaction<Dim>& on_walls, const GrainView<Dim>& grains);

  int n_grains_, max_threads_;
  Mat<Dim, bool> needs_virial_;
  SweepPlan plan_;
  RowSums<Dim> rows_;
  std::vector<BlockSums<Dim>> sums_;
};

}  // namespace floc
