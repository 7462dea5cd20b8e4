#pragma once

#include <vector>

#include "floc/relaxation/dynamics.h"
#include "floc/relaxation/hot_grains.h"
#include "floc/relaxation/hot_pairs.h"

namespace floc {

/// Dynamics under one composed law; see Dynamics. Grains are owned by blocks: a block computes the pairs whose first
/// grain it owns, then, once all rows are written, sums and integrates its grains. Sums over the packing are made
/// block by block in order.
template <int Dim, class Law>
class ExplicitDynamics final : public Dynamics<Dim> {
 public:
  ExplicitDynamics(const Packing<Dim>& packing, const Law& law, const CellControl<Dim>& control,
                   const DynamicsSettings& settings);

  void advance(int n_steps, Motion motion) override;
  bool finite() const override;
  Packing<Dim> packing() const override;
  double skin() const override { return skin_; }

 private:
  static constexpr int kBlock = 64;
  static constexpr bool kTurns = Law::kHasFriction;  ///< without friction nothing changes the spins

  /// What one block of grains adds to the sums over the packing.
  struct alignas(64) BlockSums {
    Vec<Dim> virial = Vec<Dim>::Zero();
    Vec<Dim> momentum_flux = Vec<Dim>::Zero();  ///< sum m v_a^2
    double rotation = 0.0;                      ///< sum I w^2
    double displacement_squared = 0.0;          ///< largest, since the list was built
  };

  /// Half a step of acceleration: v <- keep v + gain (half_step/m) F, axis by axis.
  struct Kick {
    double half_step;
    Vec<Dim> keep, gain;
  };

  int n_blocks() const { return (grains_.size() + kBlock - 1) / kBlock; }
  int block_end(int b) const { return std::min(grains_.size(), (b + 1) * kBlock); }

  void load_histories(const Packing<Dim>& packing);
  void kick_cell();
  void begin_step();
  Kick kick_over(double half_step) const;
  void turn(const Kick& kick, int begin);
  void kick_and_drift(int block);
  void compute_pairs(int block, double slip_time);
  void compute_pair(int p, const Law& law, const Vec<Dim>& side, const Vec<Dim>& rate, double slip_time,
                    Vec<Dim>& virial);
  void sum_forces(int k);
  void sum_and_kick(int block, double half_step);
  void end_step(Motion motion);
  void refresh_forces();
  bool list_is_stale() const;
  void rebuild_list();
  void adapt_skin();

  Packing<Dim> origin_;  ///< the packing this was made from: what does not change in time
  Law law_;
  CellControl<Dim> control_;
  double dt_;
  double skin_;
  int threads_;
  double largest_;  ///< diameter

  HotGrains<Dim> grains_;
  HotPairs<Law, Dim> pairs_;
  Vec<Dim> side_, side_rate_;  ///< L and L'
  Vec<Dim> strain_rate_;       ///< L'/L at mid-step
  Vec<Dim> stretch_, drift_;   ///< of this step: x <- stretch x + drift v
  std::vector<BlockSums> sums_;
  double kinetic_ = 0.0;  ///< total kinetic energy with the cell's, for the power control

  std::array<std::vector<double>, Dim> x_list_;  ///< positions when the list was built
  Vec<Dim> side_list_;
  Vec<Dim> list_stretch_;  ///< L / L when the list was built
  int steps_since_list_ = 0;
};

}  // namespace floc
