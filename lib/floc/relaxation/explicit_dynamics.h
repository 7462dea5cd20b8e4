#pragma once

#include <optional>
#include <vector>

#include "floc/relaxation/cell_motion.h"
#include "floc/relaxation/dynamics.h"
#include "floc/relaxation/grain_arrays.h"
#include "floc/relaxation/interactions.h"
#include "floc/relaxation/liquid_bridges.h"
#include "floc/relaxation/neighbor_lists.h"
#include "floc/relaxation/row_sums.h"
#include "floc/relaxation/sweep_plan.h"

namespace floc {

/// See Dynamics. What acts on grains is a list of interactions, each with pairs, a law and a kernel of its own;
/// their rows are summed together. Grains are owned by blocks: a block computes the pairs whose first grain it
/// owns, then, once all rows that it reads are written (SweepPlan), sums and integrates its grains. Sums over the packing are made block
/// by block in order. The code that visits every grain or pair is in kernels/, compiled for each kernel law
/// and instruction set.
template <int Dim>
class ExplicitDynamics final : public Dynamics<Dim> {
 public:
  /// @param packing  whose contacts it takes over
  ExplicitDynamics(Packing<Dim>& packing, const BoundaryControl<Dim>& control,
                   const DynamicsSettings& settings);

  void advance(int n_steps, Motion motion) override;
  bool finite() const override;
  Packing<Dim> packing() const override;
  Packing<Dim> release_packing() override;
  double skin() const override;

 private:
  void begin_step();
  void kick_and_drift(int block, Rotation stands);
  int blocks_of_group() const;
  /// @param undrifted  how the rotation of the grains stands, where they are still to drift, each block just before
  ///                   pairs read it
  void sweep(int thread, double slip_time, std::optional<Rotation> undrifted, Rotation to);
  void sum_shared_blocks(int thread, Rotation to);
  PairView<Dim> pairs_of_group(int group);
  void add_wall_virial(int block);
  void sum_and_kick(const PairView<Dim>& pairs, int block, Rotation to);
  void end_step(Motion motion);
  void refresh_forces();
  /// Finds the pairs anew if the lists are stale. @pre the motion of all blocks has been measured
  void renew_lists();
  void rebuild_lists();
  /// @param further  contacts of each interaction beside the first contact of their pair
  void build_lists(const PairLists<Dim>& further);
  void share_liquid();
  /// Gap across which grains interact.
  double range() const { return interactions_.between_grains().range(); }

  Law law_, wall_law_;
  double dt_;
  int threads_;

  GrainArrays<Dim> grains_;
  CellMotion<Dim> cell_;
  Interactions<Dim> interactions_;
  NeighborLists<Dim> lists_;
  std::optional<LiquidBridges<Dim>> liquid_;  ///< where the law has liquid
  GrainView<Dim> grain_view_;
  SweepPlan sweep_plan_;
  RowSums<Dim> sums_of_rows_;
  Kick<Dim> kick_;      ///< of each half of this step
  Drift<Dim> drift_{};  ///< of this step
  std::vector<BlockSums<Dim>> sums_;
  double kinetic_ = 0.0;  ///< total kinetic energy with the cell's, for the power control
};

}  // namespace floc
