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
  Kick<Dim> kick;    ///< coefficients of the acceleration of the grains over each half of the step
  Drift<Dim> drift;  ///< coefficients of the motion of the grains over the whole step
};

/// Passes of a time step over blocks of grains, which are shared out among threads (SweepPlan). A pair belongs to the
/// block of its first grain. Each thread computes the rows (forces and moments) of the pairs of its blocks. Once all
/// rows that a block needs are computed, the rows of each of its grains are summed and the grains are kicked. Sums over
/// the packing (virial, energies) are first computed for each block, so that the order of additions does not depend on
/// the number of threads.
///
/// All threads call the methods with the parameter `thread`. They wait at a barrier after drift_all() or
/// drift_shared(), after compute() and after sum_shared().
template <int Dim>
class ForceSweep {
 public:
  /// @param needs_virial  for each component of the virial: whether it has to be computed because it accelerates the
  /// lattice
  ForceSweep(const GrainArrays<Dim>& grains, int n_threads, const Mat<Dim, bool>& needs_virial);

  int n_threads() const { return plan_.n_threads(); }
  /// Returns the number of blocks in a group. The pairs of a group are computed in one pass and padded to whole vector
  /// registers.
  int blocks_of_group() const;
  /// Frees the memory of the rows (forces and moments of the pairs), which is large.
  /// @pre plan() is called before the next step
  void drop_rows() { rows_ = RowSums<Dim>(); }
  /// Plans the passes over newly built lists of pairs.
  void plan(Interactions<Dim>& interactions);

  /// Calls visit(block) for each block of grains that belongs to a thread.
  template <class Visit>
  void for_each_block(int thread, const Visit& visit) const {
    const int last = plan_.first_block(plan_.first_group(thread + 1));
    for (int b = plan_.first_block(plan_.first_group(thread)); b < last; ++b) visit(b);
  }
  /// Kicks and moves the grains of all blocks that belong to a thread.
  /// @param stands  stage (Rotation) that the rotation of the grains has reached in the previous step
  void drift_all(int thread, const Interactions<Dim>& interactions, const GrainStep<Dim>& step,
                 Rotation stands) const;
  /// Kicks and moves those shared blocks of grains (blocks that pairs of several threads read) that are assigned to a
  /// thread.
  void drift_shared(int thread, const Interactions<Dim>& interactions, const GrainStep<Dim>& step,
                    Rotation stands) const;
  /// Computes the forces of the pairs of all blocks that belong to a thread. For blocks that only pairs of this thread
  /// read (blocks that are not shared), also sums the forces on each grain and kicks the grain.
  /// @param undrifted  empty if the blocks that are not shared have already drifted in this step. Otherwise stage
  /// (Rotation) that the rotation of the grains has reached in the previous step; each of these blocks then drifts just
  /// before the first pairs read it.
  /// @param to  stage (Rotation) that the rotation of the grains has to reach in this step
  void compute(int thread, const Interactions<Dim>& interactions, const GrainStep<Dim>& step,
               std::optional<Rotation> undrifted, Rotation to);
  /// Sums the forces on each grain of those shared blocks (blocks that pairs of several threads read) that are assigned
  /// to a thread, and kicks the grain.
  /// @pre all threads have computed the forces of their pairs
  void sum_shared(int thread, const Interactions<Dim>& interactions, const GrainStep<Dim>& step, Rotation to);

  /// Returns the sums over the grains or pairs of each block (virial, kinetic energy, largest speed).
  const std::vector<BlockSums<Dim>>& sums() const { return sums_; }
  double twice_kinetic_energy() const;
  /// Sets the sums that contain velocities or spins to zero; to be called after the grains have been stopped.
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
