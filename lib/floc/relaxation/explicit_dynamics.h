#pragma once

#include <array>
#include <optional>
#include <vector>

#include "floc/packing/liquid.h"
#include "floc/relaxation/cell_motion.h"
#include "floc/relaxation/dynamics.h"
#include "floc/relaxation/grain_arrays.h"
#include "floc/relaxation/interactions.h"
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
  int n_blocks() const { return (grains_.size() + kGrainBlock - 1) / kGrainBlock; }

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
  double list_cost_share() const;
  double consumed_skin() const;
  void bound_motion();
  void measure_motion(int block);
  void take_measured_motion();
  double min_skin() const;
  std::vector<double> skin_shares() const;
  double shrink_since_list() const;
  bool list_is_stale() const;
  double out_of_range_share(const std::vector<NeighborPair<Dim>>& pairs) const;
  void renew_list();
  void rebuild_list();
  /// @param further  contacts of each interaction beside the first one of their pair
  void build_lists(const PairLists<Dim>& further);
  bool shares_liquid() const { return bridges_.has_value() && !holds_liquid_; }
  void set_first_reach(const Packing<Dim>& packing);
  double reach_of_liquid() const;
  double gap_of(const NeighborPair<Dim>& pair) const;
  LiquidShares share_liquid();
  void spread_liquid();
  PairLists<Dim> close_pairs();
  std::vector<NeighborPair<Dim>> close_pairs(const Interaction<Dim>& interaction, const Grains<Dim>& now) const;
  void adapt_skin();

  Law law_, wall_law_;
  bool holds_liquid_;
  CellMotion<Dim> cell_;
  double dt_;
  double skin_;
  int threads_;
  double largest_diameter_;
  double skin_unit_;  ///< skin_length_unit()

  GrainArrays<Dim> grains_;
  Interactions<Dim> interactions_;
  GrainView<Dim> grain_view_;
  SweepPlan sweep_plan_;
  RowSums<Dim> sums_of_rows_;
  Kick<Dim> kick_;      ///< of each half of this step
  Drift<Dim> drift_{};  ///< of this step
  std::vector<BlockSums<Dim>> sums_;
  double kinetic_ = 0.0;  ///< total kinetic energy with the cell's, for the power control

  std::array<AlignedVector<double>, Dim> x_list_;  ///< positions when the list was built
  AlignedVector<double> inverse_skin_squared_;     ///< of the distances that grains may move from there
  Mat<Dim> lattice_at_list_;
  Mat<Dim> list_stretch_;                ///< deformation since the list was built
  std::optional<BridgeSearch> bridges_;  ///< where the law has liquid
  /// No grain has moved further since the list was built, in halves of its skin; and what rounding may add in a step.
  double moved_ = 0.0, rounding_ = 0.0;
  std::vector<double> motion_of_block_;  ///< when it was last measured
  int steps_since_list_ = 0;
  bool on_first_list_ = true;
  double out_of_range_share_ = 0.0;  ///< of a step, when the list was built
};

}  // namespace floc
