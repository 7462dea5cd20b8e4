#pragma once

#include <optional>
#include <vector>

#include "floc/relaxation/grain_arrays.h"
#include "floc/relaxation/interactions.h"
#include "floc/relaxation/row_sums.h"
#include "floc/relaxation/sweep_plan.h"

namespace floc {

/// Data that the passes over blocks of grains read in a time step.
template <int Dim>
struct GrainStep {
  GrainView<Dim> grains;
  PairCell<Dim> cell;
  Kick<Dim> kick;    ///< kick over each half of the step
  Drift<Dim> drift;  ///< drift over the whole step, between the two kicks
};

/// The passes of a time step over blocks of grains, shared out among threads (SweepPlan). A block owns the pairs
/// whose first grain it owns. Each thread computes the rows of the pairs of its blocks; once all rows that a block
/// reads are written, the rows of its grains are summed and the grains are kicked. Sums over the packing are kept
/// block by block, so that the order of additions does not depend on the number of threads.
///
/// All threads call the methods that take a thread's number, with a barrier after each of the drift, compute() and
/// sum_shared().
template <int Dim>
class ForceSweep {
 public:
  /// @param needs_virial  components of the virial that drive the lattice
  ForceSweep(const GrainArrays<Dim>& grains, int n_threads, const Mat<Dim, bool>& needs_virial);

  int n_threads() const { return plan_.n_threads(); }
  /// Number of blocks whose pairs are computed in one pass. Lists of pairs are padded accordingly.
  int blocks_of_group() const;
  /// Drops the rows, which are large. @pre plan() is called before the next step
  void drop_rows() { rows_ = RowSums<Dim>(); }
  /// Plans the passes over new lists of pairs.
  void plan(Interactions<Dim>& interactions);

  /// Calls visit(block) for each block of a thread.
  template <class Visit>
  void for_each_block(int thread, const Visit& visit) const {
    const int last = plan_.first_block(plan_.first_group(thread + 1));
    for (int b = plan_.first_block(plan_.first_group(thread)); b < last; ++b) visit(b);
  }
  /// Kicks and moves all blocks of a thread.
  /// @param stands  stage of the rotation of the grains
  void drift_all(int thread, const Interactions<Dim>& interactions, const GrainStep<Dim>& step,
                 Rotation stands) const;
  /// Kicks and moves a thread's part of the shared blocks, which pairs of other threads read, too.
  void drift_shared(int thread, const Interactions<Dim>& interactions, const GrainStep<Dim>& step,
                    Rotation stands) const;
  /// Computes the pairs of a thread's blocks, and sums and kicks those blocks that are not shared.
  /// @param undrifted  stage of the rotation of blocks that have still to drift, if blocks that are not shared
  /// have not drifted yet; each drifts just before pairs read it
  /// @param to  stage at which the rotation is left
  void compute(int thread, const Interactions<Dim>& interactions, const GrainStep<Dim>& step,
               std::optional<Rotation> undrifted, Rotation to);
  /// Sums and kicks a thread's part of the shared blocks. @pre all threads have computed their pairs
  void sum_shared(int thread, const Interactions<Dim>& interactions, const GrainStep<Dim>& step, Rotation to);

  /// Contribution of each block to the sums over the packing.
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
