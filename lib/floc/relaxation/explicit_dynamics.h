#pragma once

#include <array>
#include <vector>

#include "floc/relaxation/dynamics.h"
#include "floc/relaxation/hot_grains.h"
#include "floc/relaxation/hot_pairs.h"

namespace floc {

/// See Dynamics. Grains are owned by blocks: a block computes the pairs whose first grain it owns, then, once
/// all rows are written, sums and integrates its grains. Sums over the packing are made block by block in
/// order. What visits every grain or pair is in kernels/, compiled for each law and instruction set.
template <int Dim>
class ExplicitDynamics final : public Dynamics<Dim> {
 public:
  ExplicitDynamics(const Packing<Dim>& packing, const BoundaryControl<Dim>& control,
                   const DynamicsSettings& settings);

  void advance(int n_steps, Motion motion) override;
  bool finite() const override;
  Packing<Dim> packing() const override;
  double skin() const override;

 private:
  int n_blocks() const { return (grains_.size() + kGrainBlock - 1) / kGrainBlock; }

  void load_memory(const Packing<Dim>& packing);
  void kick_lattice();
  void impose_rates();
  Mat<Dim> unbalanced_work() const;
  void begin_step();
  PairCell<Dim> pair_cell(double slip_time) const;
  Kick<Dim> kick_over(double half_step) const;
  void kick_and_drift(int block);
  void compute_pairs(int block, double slip_time);
  void sum_and_kick(int block);
  void end_step(Motion motion);
  void refresh_forces();
  double list_cost_share() const;
  double eaten_skin() const;
  double shrink_since_list() const;
  Vec<Dim> image_shift(const Vec<Dim, int>& image) const;
  bool list_is_stale() const;
  double share_of_idle(const std::vector<NeighborPair<Dim>>& pairs) const;
  void rebuild_list();
  void adapt_skin();

  LawParameters parameters_;  ///< of the law
  AnyContactLaw law_;
  const void* composed_law_;  ///< the alternative in law_
  double range_;              ///< of the law
  ContactMemory<Dim> swap_parity_;
  const StepKernels<Dim>& kernels_;
  BoundaryControl<Dim> control_;
  double dt_;
  double skin_;
  int threads_;
  double largest_;        ///< diameter
  double thinnest_skin_;  ///< (length)

  HotGrains<Dim> grains_;
  HotPairs<Dim> pairs_;
  GrainArrays<Dim> grain_arrays_;
  PairArrays<Dim> pair_arrays_;
  // The lattice vectors are columns here: upper triangular matrices, diagonal for a rectangular cell.
  Mat<Dim> lattice_, lattice_rate_;  ///< h and h'
  Mat<Dim> strain_rate_;             ///< velocity gradient h' h^-1 at mid-step
  Kick<Dim> kick_;                   ///< of each half of this step
  Drift<Dim> drift_;                 ///< of this step
  std::vector<BlockSums<Dim>> sums_;
  double kinetic_ = 0.0;  ///< total kinetic energy with the cell's, for the power control

  std::array<std::vector<double>, Dim> x_list_;  ///< positions when the list was built
  Mat<Dim> lattice_at_list_;
  Mat<Dim> list_stretch_;  ///< deformation since the list was built
  int steps_since_list_ = 0;
  bool on_first_list_ = true;
  double idle_share_ = 0.0;  ///< of a step, when the list was built
};

}  // namespace floc
