#pragma once

#include <optional>

#include "floc/relaxation/cell_motion.h"
#include "floc/relaxation/dynamics.h"
#include "floc/relaxation/force_sweep.h"
#include "floc/relaxation/grain_arrays.h"
#include "floc/relaxation/interactions.h"
#include "floc/relaxation/liquid_bridges.h"
#include "floc/relaxation/neighbor_lists.h"
#include "floc/relaxation/thread_team.h"

namespace floc {

/// Velocity Verlet steps of a packing (Dynamics). A step kicks and drifts the boundary (CellMotion), then the grains
/// block by block, computes the forces between them and kicks them again (ForceSweep), after the pairs have been found
/// anew where bodies have moved too far (NeighborLists), and ends with the second kick of the boundary. The code that
/// visits every grain or pair is in kernels/, compiled for each kernel law and instruction set.
template <int Dim>
class ExplicitDynamics final : public Dynamics<Dim> {
 public:
  /// @param packing  whose contacts are taken over
  ExplicitDynamics(Packing<Dim>& packing, const BoundaryControl<Dim>& control,
                   const DynamicsSettings& settings);

  void advance(int n_steps, Motion motion) override;
  bool finite() const override;
  Packing<Dim> packing() const override;
  Packing<Dim> release_packing() override;
  double skin() const override;

 private:
  /// The part that one thread of the team has in a time step.
  /// @param from, to  how the rotation of the grains stands before and after it
  void step(int thread, Barrier& barrier, Motion motion, Rotation from, Rotation to);
  void begin_step();
  void end_step(Motion motion);
  void stop_if_slowing();
  /// Measures the motion since the last list of a thread's grains.
  void measure_motion(int thread);
  void refresh_forces();

  void renew_stale_lists();
  /// @param further  contacts of each interaction beside the first contact of their pair
  void build_lists(const PairLists<Dim>& further);
  void share_liquid();
  /// Gap across which grains interact (length).
  double range() const { return interactions_.between_grains().range(); }

  Law law_, wall_law_;
  double dt_;
  GrainArrays<Dim> grains_;
  CellMotion<Dim> cell_;
  Interactions<Dim> interactions_;
  NeighborLists<Dim> lists_;
  std::optional<LiquidBridges<Dim>> liquid_;  ///< where the law has liquid
  ForceSweep<Dim> sweep_;
  GrainStep<Dim> step_{};
  double twice_kinetic_ = 0.0;  ///< of grains and boundary, after the last step under power control
};

}  // namespace floc
